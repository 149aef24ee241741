//! Marching through layers against exact chains through nested balls: the share
//! of pixels within one degree and the mean angle, over pixels whose exact chain
//! meets no total reflection.

#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use glam::{DAffine3, DVec3};
use realtime::{Gpu, Keep, Request, render};
use scenes::{Camera, LayerName, MediumId, Object, Projection, Scene, Shape, Surface};
use test_support::{angle, centre_rays, parallel, vectors, view};

/// A ball of radius 1 about the origin, of glass, with at most one hole.
struct Body {
    eta: f64,
    hole: Option<(DVec3, f64)>,
}

fn scene(body: &Body, size_px: u32) -> Scene {
    let ball = |name: &str, centre, radius_m, medium, priority| Object {
        surface: Surface::Dielectric { medium: MediumId(medium), priority },
        world_from_object: DAffine3::from_translation(centre),
        ..Object::solid(name, Shape::Sphere { radius_m }, MediumId(medium))
    };
    let mut objects = vec![ball("glass", DVec3::ZERO, 1.0, 1, 0)];
    objects.extend(body.hole.map(|(centre, radius_m)| ball("hole", centre, radius_m, 0, 1)));
    test_support::scene(objects, body.eta, parallel(2.1, [size_px; 2]))
}

/// Exit direction of the chain that always transmits; `None` where it misses
/// the ball or is totally reflected.
fn exact(body: &Body, mut origin: DVec3, mut d: DVec3) -> Option<DVec3> {
    let mut balls = vec![(DVec3::ZERO, 1.0)];
    balls.extend(body.hole);
    let mut inside = vec![false; balls.len()];
    let mut events = 0;
    loop {
        let hits = balls.iter().enumerate().filter_map(|(i, (centre, radius))| {
            let o = origin - *centre;
            let b = o.dot(d);
            let h_2 = radius * radius - (o - b * d).length_squared();
            let t = if inside[i] { -b + h_2.max(0.0).sqrt() } else { -b - h_2.max(0.0).sqrt() };
            (h_2 > 0.0 && (inside[i] || t > 1e-9)).then_some((t, i))
        });
        let Some((t, i)) = hits.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return (events > 0).then_some(d);
        };
        let glass = |inside: &[bool]| inside[0] && !inside.get(1).copied().unwrap_or(false);
        let eta_of = |glass: bool| if glass { body.eta } else { 1.0 };
        let eta_i = eta_of(glass(&inside));
        inside[i] = !inside[i];
        let eta_t = eta_of(glass(&inside));
        origin += t * d;
        let outward = (origin - balls[i].0).normalize();
        let n = if d.dot(outward) < 0.0 { outward } else { -outward };
        let (eta, c) = (eta_i / eta_t, -d.dot(n));
        let k = 1.0 - eta * eta * (1.0 - c * c);
        if k < 0.0 {
            return None;
        }
        d = (eta * d + (eta * c - k.sqrt()) * n).normalize();
        events += 1;
    }
}

/// Share of pixels within one degree, and the mean angle in degrees.
fn errors(gpu: &Gpu, body: &Body, size_px: u32, method: &str) -> (f64, f64) {
    errors_seen(gpu, body, &scene(body, size_px), method, &[])
}

/// The same from another camera, with parameters.
fn errors_seen(
    gpu: &Gpu,
    body: &Body,
    scene: &Scene,
    method: &str,
    parameters: &[(&str, &str)],
) -> (f64, f64) {
    let [size_px, _] = scene.camera.resolution_px;
    let view = view(size_px, 1, &[LayerName::Exit]);
    let parameters = test_support::parameters(parameters);
    let request = Request { parameters, ..Request::new(view, method, Keep::Needed) };
    let rendering = render(gpu, scene, &request).unwrap();
    let exits = vectors(&rendering.layers, &LayerName::Exit);
    let (mut within, mut sum, mut count) = (0.0, 0.0, 0.0);
    for (found, ray) in exits.into_iter().zip(centre_rays(&scene.camera)) {
        let Some(expected) = exact(body, ray.origin, ray.direction) else { continue };
        if found == DVec3::ZERO {
            continue;
        }
        let angle_deg = angle(expected, found).to_degrees();
        within += f64::from(u8::from(angle_deg < 1.0));
        sum += angle_deg;
        count += 1.0;
    }
    (within / count, sum / count)
}

/// Light that leaves through a part of the body that the image does not show is
/// lost to layers of the image, and not to layers with a camera of their own.
#[test]
fn layers_with_a_camera_of_their_own_hold_what_the_image_cuts_off() {
    let gpu = Gpu::open(None).unwrap();
    let body = Body { eta: 1.5, hole: None };
    let aside = 1.4 * DVec3::X;
    for projection in [
        Projection::Orthographic { height_m: 2.1 },
        Projection::Perspective { vertical_fov_deg: 30.0 },
    ] {
        let mut scene = scene(&body, 256);
        let Camera { eye, target, .. } = scene.camera;
        scene.camera =
            Camera { eye: eye + aside, target: target + aside, projection, ..scene.camera };
        for method in ["multi", "multi-paper"] {
            let seen = |camera: &str, edge_px: &str| {
                let parameters = [("peel_camera", camera), ("peel_px", edge_px)];
                let parameters = if camera == "screen" { &parameters[..1] } else { &parameters };
                errors_seen(&gpu, &body, &scene, method, parameters)
            };
            let (screen, fitted) = (seen("screen", "0"), seen("fitted", "1024"));
            assert!(screen.0 < 0.6, "{method} {projection:?}: {screen:?}");
            assert!(fitted.0 > 0.95 && fitted.1 < 0.3, "{method} {projection:?}: {fitted:?}");
            // It is as precise as it has pixels.
            let coarse = seen("fitted", "128");
            assert!(coarse.1 > 3.0 * fitted.1, "{method} {projection:?}: {coarse:?} {fitted:?}");
        }
    }
}

const SHELL: Option<(DVec3, f64)> = Some((DVec3::ZERO, 0.8));
const THIN: Option<(DVec3, f64)> = Some((DVec3::ZERO, 0.97));
const BUBBLE: Option<(DVec3, f64)> = Some((DVec3::new(0.3, 0.2, 0.1), 0.35));

/// Shares within 0.03 and means within 20 % of an independent prototype's.
#[test]
fn marching_reaches_what_the_prototype_reached() {
    let gpu = Gpu::open(None).unwrap();
    let cases = [
        ("ball", 1.2, None, 256, (0.990, 0.11), (0.990, 0.11)),
        ("ball", 1.5, None, 256, (0.981, 0.21), (0.982, 0.20)),
        ("shell", 1.2, SHELL, 256, (0.645, 9.2), (0.908, 0.64)),
        ("shell", 1.5, SHELL, 256, (0.631, 7.5), (0.837, 1.02)),
        ("thin shell", 1.2, THIN, 256, (0.894, 1.2), (0.888, 0.53)),
        ("thin shell", 1.5, THIN, 256, (0.831, 2.1), (0.817, 1.01)),
        ("bubble", 1.2, BUBBLE, 256, (0.779, 5.9), (0.966, 0.27)),
        ("bubble", 1.5, BUBBLE, 256, (0.676, 14.6), (0.940, 0.57)),
    ];
    let mut wrong = Vec::new();
    for (name, eta, hole, size_px, paper, winding) in cases {
        for (method, expected) in [("multi-paper", paper), ("multi", winding)] {
            let found = errors(&gpu, &Body { eta, hole }, size_px, method);
            if (found.0 - expected.0).abs() > 0.03 || (found.1 / expected.1 - 1.0).abs() > 0.2 {
                wrong.push(format!("{name} {eta} {method}: {found:.3?} instead of {expected:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
