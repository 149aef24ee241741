//! Single rays into real scenes against textbook geometry, through the code that
//! renders images: a one-pixel image of a parallel camera is one ray.

#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use glam::{DAffine3, DVec3};
use reference::{Estimator, Level, Request, render};
use scenes::environment::{Environment, Map};
use scenes::{Cube, LayerName, Scene, Shape};
use std::sync::Arc;
use test_support::{angle, ray, view};

fn scene(objects: &str) -> Scene {
    let text = format!(
        "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\northographic_height_m = 1e-9\nresolution_px = [1, 1]\n\
         [environment]\nradiance = [1.0, 1.0, 1.0]\n{objects}"
    );
    scenes::parse(&text, "test", std::path::Path::new("")).unwrap()
}

fn solid(shape: &str, eta: f64) -> String {
    format!(
        "[[object]]\nshape = {shape}\nnormals = \"flat\"\nsurface = \"dielectric\"\nmedium = {{ eta = {eta} }}\n"
    )
}

fn ball(eta: f64) -> Scene {
    scene(&solid("{ sphere = { radius_m = 1.0 } }", eta))
}

struct Chain {
    exit: DVec3,
    position: DVec3,
    events: f64,
}

/// The chain that always transmits, of one ray.
fn chain(scene: &mut Scene, origin: DVec3, direction: DVec3) -> Chain {
    scene.camera = ray(origin, direction);
    let layers = [LayerName::Exit, LayerName::ExitPosition, LayerName::Events];
    let rendering = render(scene, &Request::new(view(1, 1, &layers), Level::R0)).unwrap();
    let vector = |name| DVec3::from_slice(&rendering.layers.get(&name).unwrap().data);
    Chain {
        exit: vector(LayerName::Exit),
        position: vector(LayerName::ExitPosition),
        events: rendering.layers.get(&LayerName::Events).unwrap().data[0],
    }
}

/// Radiance of one ray, the whole tree down to a weight of 1e-14.
fn radiance(scene: &mut Scene, origin: DVec3, direction: DVec3) -> f64 {
    scene.camera = ray(origin, direction);
    let mut request = Request::new(view(1, 1, &[LayerName::Radiance]), Level::R1);
    request.estimator = Estimator::Tree { cut: 1e-14 };
    render(scene, &request).unwrap().layers.get(&LayerName::Radiance).unwrap().data[0]
}

/// Light only from where z > 0.
fn half_lit() -> Environment {
    let cube = Cube::from_fn(64, |d| if d.z > 0.0 { DVec3::ONE } else { DVec3::ZERO });
    let Environment::Map(like) = scenes::builtin("ball").unwrap().environment else { panic!() };
    Environment::Map(Arc::new(Map { cube, ..(*like).clone() }))
}

/// A ray that passes a ball's centre at b is turned by 2 (asin b - asin b/n).
#[test]
fn a_ball_turns_a_ray_by_twice_the_difference_of_its_angles() {
    for eta in [1.000_001, 1.1, 1.309, 1.5, 2.417, 10.0, 1e4] {
        for b in [0.01f64, 0.3, 0.7, 0.95, 0.999_9] {
            let found = chain(&mut ball(eta), DVec3::new(b, 0.0, 5.0), DVec3::NEG_Z);
            let turn = 2.0 * (b.asin() - (b / eta).asin());
            // Leaving multiplies the sine, and its rounding, by the index: no f64
            // tracer can know the last angle better than this.
            let conditioning = 4.0 * f64::EPSILON * eta / (1.0 - b * b).sqrt();
            let error = (angle(found.exit, DVec3::NEG_Z) - turn).abs();
            assert!(error < f64::max(1e-12, conditioning), "{eta} {b}: {error:e}");
            assert!(found.exit.x <= 0.0 && found.events == 2.0);
        }
    }
}

/// Where rays cross the axis behind a ball of index 1.5, in radii from its centre.
#[test]
fn a_ball_lens_has_its_textbook_foci() {
    for (b, focus) in [(0.01, 1.499_96), (0.5, 1.391_57), (0.9, 1.104_45)] {
        let found = chain(&mut ball(1.5), DVec3::new(b, 0.0, 5.0), DVec3::NEG_Z);
        let t = -found.position.x / found.exit.x;
        let z = found.position.z + t * found.exit.z;
        assert!((-z - focus).abs() < 1e-5, "{b}: {z}");
    }
}

/// Hollow concentric shell, index 1.5, radii 1 and 0.8; degrees away from the axis.
#[test]
fn a_hollow_ball_turns_rays_as_three_cases_of_geometry_say() {
    let hollow = "[[object]]\nshape = { sphere = { radius_m = 0.8 } }\nsurface = \"dielectric\"\n\
                  medium = \"vacuum\"\npriority = 1\n";
    let mut scene = scene(&format!("{}{hollow}", solid("{ sphere = { radius_m = 1.0 } }", 1.5)));
    for (b, degrees) in
        [(0.1, 0.967_894), (0.7, 17.501_552), (0.85, 42.413_933), (0.95, 10.299_629)]
    {
        let found = chain(&mut scene, DVec3::new(b, 0.0, 5.0), DVec3::NEG_Z);
        let turned = angle(found.exit, DVec3::NEG_Z).to_degrees();
        assert!((turned - degrees).abs() < 1e-6, "{b}: {turned}");
    }
}

/// Minimum deviation of an equilateral prism of index 1.5 is 37.1808 degrees;
/// the index follows from it by n = sin((A + d) / 2) / sin(A / 2).
#[test]
fn a_prism_deviates_least_where_light_passes_symmetrically() {
    let mut scene = scene(&solid("{ builtin = \"prism\" }", 1.5));
    let least = (0..2000)
        .filter_map(|i| {
            let theta = f64::from(i) * 1e-3;
            let d = DVec3::new(theta.cos(), theta.sin(), 0.0);
            let found = chain(&mut scene, DVec3::new(-0.05, 0.02, 0.0) - 4.0 * d, d);
            let turn = angle(found.exit, d).to_degrees();
            (found.events == 2.0 && turn > 1.0).then_some(turn)
        })
        .fold(f64::INFINITY, f64::min);
    assert!((least - 37.180_8).abs() < 1e-3, "{least}");
}

/// In a rod of index above sqrt 2 light that enters through an end leaves through
/// an end: its direction changes sign in some components and nothing else.
#[test]
fn a_long_rod_returns_the_direction_after_hundreds_of_total_reflections() {
    let mut scene = scene(&solid("{ box = { half_extent_m = [0.5, 0.5, 400.0] } }", 1.5));
    let d = DVec3::new(0.55, 0.5, -1.0).normalize();
    let found = chain(&mut scene, DVec3::new(0.1, -0.2, 400.0) - 3.0 * d, d);
    assert!(found.events > 400.0, "{}", found.events);
    assert!((found.exit.abs() - d.abs()).abs().max_element() < 1e-12, "{:?}", found.exit);
}

/// Three faces at right angles send light back whence it came.
#[test]
fn a_corner_cube_returns_light() {
    let mut scene = scene(&solid("{ builtin = \"corner-cube\" }", 1.5));
    let mesh = scenes::generate::builtin("corner-cube").unwrap();
    // The entrance is the face whose normal has three equal components.
    let entrance = (0..mesh.triangles.len())
        .map(|i| mesh.corners(i))
        .find(|c| {
            let n = (c[1] - c[0]).cross(c[2] - c[0]).normalize().abs();
            (n - DVec3::splat(1.0 / 3f64.sqrt())).length() < 1e-9
        })
        .unwrap();
    let normal = (entrance[1] - entrance[0]).cross(entrance[2] - entrance[0]).normalize();
    for (u, v, tilt) in [(0.3, 0.35, 0.0), (0.4, 0.3, 0.02), (0.25, 0.45, 0.03)] {
        let at = entrance[0] * (1.0 - u - v) + entrance[1] * u + entrance[2] * v;
        let sideways = (entrance[1] - entrance[0]).normalize();
        let d = (-normal + tilt * sideways).normalize();
        let found = chain(&mut scene, at - 2.0 * d, d);
        assert!((found.exit + d).length() < 1e-13, "{:?} {d:?}", found.exit);
        assert_eq!(found.events, 5.0);
    }
}

/// A lossless slab reflects 2R/(1+R) of the light in all.
#[test]
fn a_slab_splits_light_as_the_sum_over_its_reflections() {
    for (degrees, reflected, transmitted) in
        [(0.0, 0.076_923, 0.923_077), (60.0, 0.163_768, 0.836_232)]
    {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let mut scene = scene(&solid("{ slab = { thickness_m = 1.0 } }", 1.5));
        scene.environment = half_lit();
        let from = |side: f64| {
            let d = DVec3::new(sin, 0.0, -cos * side);
            (-4.0 * d, d)
        };
        let (origin, d) = from(1.0);
        assert!((radiance(&mut scene, origin, d) - reflected).abs() < 1e-6);
        let (origin, d) = from(-1.0);
        assert!((radiance(&mut scene, origin, d) - transmitted).abs() < 1e-6);
    }
}

/// A slab one optical depth thick: what it reflects and transmits together.
#[test]
fn an_absorbing_slab_keeps_what_beer_and_lambert_say() {
    for (degrees, light) in [(0.0, 0.339_111 + 0.044_990), (60.0, 0.243_925 + 0.095_579)] {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let slab = "[[object]]\nshape = { slab = { thickness_m = 1.0 } }\nsurface = \"dielectric\"\n\
                    medium = { eta = 1.5, absorption_per_m = [1.0, 1.0, 1.0] }\n";
        let d = DVec3::new(sin, 0.0, -cos);
        let found = radiance(&mut scene(slab), -4.0 * d, d);
        assert!((found - light).abs() < 2e-6, "{degrees}: {found} {light}");
    }
}

/// Turned round, light takes the same way back.
#[test]
fn light_is_reversible() {
    for shape in
        ["{ sphere = { radius_m = 1.0 } }", "{ builtin = \"torus\" }", "{ builtin = \"ice-cube\" }"]
    {
        let mut scene = scene(&solid(shape, 1.309));
        for (x, y) in [(0.61, 0.13), (0.3, -0.22), (-0.71, 0.33)] {
            let origin = DVec3::new(x, y, 4.0);
            let there = chain(&mut scene, origin, DVec3::NEG_Z);
            if there.events < 2.0 || there.exit == DVec3::ZERO || there.events > 6.0 {
                continue;
            }
            let back = chain(&mut scene, there.position + 3.0 * there.exit, -there.exit);
            assert!((back.exit - DVec3::Z).length() < 1e-9, "{shape} {x} {y}: {:?}", back.exit);
            let beside = back.position - origin;
            assert!((beside - beside.z * DVec3::Z).length() < 1e-9, "{shape}");
        }
    }
}

/// Twice as large, 2^k times as large: the same bits. No length is built in.
#[test]
fn a_scene_scaled_by_a_power_of_two_is_the_same_image_bit_by_bit() {
    let original = scenes::builtin("ice-cube").unwrap();
    let image = |scene: &Scene| {
        let view = view(24, 1, &[LayerName::Radiance, LayerName::Exit]);
        let layers = render(scene, &Request::new(view, Level::R1)).unwrap().layers;
        layers.list.iter().flat_map(|l| l.data.iter().map(|v| v.to_bits())).collect::<Vec<u64>>()
    };
    let scaled = |factor: f64| {
        let mut scene = original.clone();
        scene.camera.eye *= factor;
        scene.camera.target *= factor;
        for object in &mut scene.objects {
            object.world_from_object =
                DAffine3::from_scale(DVec3::splat(factor)) * object.world_from_object;
        }
        scene
    };
    let unit = image(&original);
    for k in [-20, -7, 3, 20] {
        assert!(image(&scaled(2f64.powi(k))) == unit, "2^{k}");
    }
    // The control: a scene that is not the same is not the same image.
    let mut other = original.clone();
    other.camera.eye.x += 1e-6;
    assert!(image(&other) != unit);
}

/// The camera inside sees L, not n² L, and uniform light is uniform there too.
#[test]
fn a_camera_inside_glass_sees_the_radiance_itself() {
    let mut scene = ball(1.5);
    for d in [DVec3::NEG_Z, DVec3::new(0.3, 0.5, -0.4), DVec3::Y] {
        let found = radiance(&mut scene, DVec3::new(0.2, 0.1, 0.3), d.normalize());
        assert!((found - 1.0).abs() < 1e-9, "{found}");
    }
}

/// The diffuse reflectance of an interface, integrated over the hemisphere.
#[test]
fn fresnel_integrates_to_its_diffuse_reflectance() {
    for (eta, outside) in [(1.309, 0.062_581), (1.5, 0.091_778), (2.417, 0.212_188)] {
        let steps = 20_000;
        let mean = |eta_i: f64, eta_t: f64| {
            (0..steps)
                .map(|i| {
                    // cos² uniform in [0, 1] weighs directions by their cosine.
                    let cos = ((f64::from(i) + 0.5) / f64::from(steps)).sqrt();
                    reference::interface::fresnel(cos, eta_i, eta_t)
                })
                .sum::<f64>()
                / f64::from(steps)
        };
        assert!((mean(1.0, eta) - outside).abs() < 1e-5, "{eta}");
        let inside = 1.0 - (1.0 - outside) / (eta * eta);
        assert!((mean(eta, 1.0) - inside).abs() < 1e-4, "{eta}");
    }
}

/// Index, Abbe number and lines of borosilicate crown glass.
#[test]
fn bk7_has_its_catalogue_values() {
    let scene = scenes::builtin("dispersion-ball").unwrap();
    let medium = &scene.media[1];
    let [c, d, f] = [0.656_272_5, 0.587_561_8, 0.486_132_7].map(|um| medium.eta_at(um));
    assert!(
        (d - 1.516_80).abs() < 5e-6 && (f - 1.522_376).abs() < 1e-6 && (c - 1.514_322).abs() < 1e-6
    );
    assert!(((d - 1.0) / (f - c) - 64.167).abs() < 1e-3);
    assert!(matches!(*scene.objects[0].shape, Shape::Sphere { .. }));
}
