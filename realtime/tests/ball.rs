//! A ball seen by parallel rays: every method's mean angle to the exact exit
//! direction, which is known in closed form, against values computed apart.

#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use glam::DVec3;
use realtime::{Gpu, Keep, Request, render};
use scenes::{LayerName, Scene, Shape};
use test_support::{angle, body, centre_rays, parallel, scene, vectors, view};

const SIZE_PX: u32 = 512;

fn ball(eta: f64) -> Scene {
    scene(vec![body(Shape::Sphere { radius_m: 1.0 })], eta, parallel(2.1, [SIZE_PX; 2]))
}

fn mean_angle_deg(gpu: &Gpu, eta: f64, method: &str, parameters: &[(&str, &str)]) -> f64 {
    let scene = ball(eta);
    let view = view(SIZE_PX, 1, &[LayerName::Exit]);
    let parameters = test_support::parameters(parameters);
    let request = Request { parameters, ..Request::new(view, method, Keep::Needed) };
    let rendering = render(gpu, &scene, &request).unwrap();
    let exits = vectors(&rendering.layers, &LayerName::Exit);
    let (mut sum, mut count) = (0.0, 0u32);
    for (d, ray) in exits.into_iter().zip(centre_rays(&scene.camera)) {
        let Some(exact) = through_ball(ray.origin, ray.direction, eta) else { continue };
        if d == DVec3::ZERO {
            continue;
        }
        sum += angle(exact, d).to_degrees();
        count += 1;
    }
    assert!(count > 170_000);
    sum / f64::from(count)
}

/// Deviation of the ray that is refracted twice: 2 (theta - theta').
fn through_ball(origin: DVec3, d: DVec3, eta: f64) -> Option<DVec3> {
    let offset = origin - origin.dot(d) * d;
    let sin = offset.length();
    if sin >= 1.0 {
        return None;
    }
    let turn = 2.0 * (sin.asin() - (sin / eta).asin());
    Some(turn.cos() * d - turn.sin() * offset.normalize_or_zero())
}

/// Index, method, parameters, expected mean in degrees, allowed difference.
type Case = (f64, &'static str, &'static [(&'static str, &'static str)], f64, f64);

#[allow(clippy::approx_constant, reason = "6.28 is an angle that was measured, not a turn")]
const CASES: &[Case] = &[
    (1.309, "undeviated", &[], 27.3, 0.1),
    (1.309, "dx7", &[], 33.4, 0.1),
    (1.309, "dx7", &[("a", "direct")], 21.3, 0.1),
    (1.309, "one-interface", &[], 13.7, 0.1),
    (1.1, "one-interface", &[], 6.05, 0.01),
    (1.2, "one-interface", &[], 10.19, 0.01),
    (1.5, "one-interface", &[], 18.20, 0.01),
    (2.0, "one-interface", &[], 25.38, 0.01),
    (1.1, "one-interface", &[("index", "ball")], 1.12, 0.01),
    (1.2, "one-interface", &[("index", "ball")], 2.19, 0.01),
    (1.309, "one-interface", &[("index", "ball")], 3.11, 0.01),
    (1.5, "one-interface", &[("index", "ball")], 4.27, 0.01),
    (1.309, "blended", &[], 21.3, 0.1),
    (1.309, "blended", &[("back_normal", "inward")], 5.9, 0.1),
    (1.309, "blended", &[("normal", "raw")], 22.5, 0.1),
    (1.5, "blended", &[], 28.0, 0.1),
    (1.5, "blended", &[("back_normal", "inward")], 8.3, 0.1),
    (1.1, "two-interface", &[("distance", "view")], 1.54, 0.01),
    (1.1, "two-interface", &[("distance", "normal")], 1.93, 0.01),
    (1.1, "two-interface", &[], 0.730, 0.001),
    (1.2, "two-interface", &[("distance", "view")], 3.59, 0.01),
    (1.2, "two-interface", &[("distance", "normal")], 3.46, 0.01),
    (1.2, "two-interface", &[], 1.742, 0.001),
    (1.309, "two-interface", &[("distance", "view")], 5.76, 0.01),
    (1.309, "two-interface", &[("distance", "normal")], 4.73, 0.01),
    (1.309, "two-interface", &[], 2.836, 0.001),
    (1.5, "two-interface", &[("distance", "view")], 9.12, 0.01),
    (1.5, "two-interface", &[("distance", "normal")], 6.28, 0.01),
    (1.5, "two-interface", &[], 4.551, 0.001),
    (2.0, "two-interface", &[("distance", "view")], 15.51, 0.01),
    (2.0, "two-interface", &[("distance", "normal")], 8.31, 0.01),
    (2.0, "two-interface", &[], 7.830, 0.001),
];

/// Means to the digits of the table; one unit of the last digit is allowed.
#[test]
fn methods_miss_a_ball_by_as_much_as_theory_says() {
    let gpu = Gpu::open(None).unwrap();
    let mut wrong = Vec::new();
    for (eta, method, parameters, expected, unit) in CASES {
        let found = mean_angle_deg(&gpu, *eta, method, parameters);
        if (found - expected).abs() > *unit {
            wrong.push(format!(
                "{method} {parameters:?} at {eta}: {found:.4} instead of {expected}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Looked up along the ray, the normal of a ball is the ray itself: nothing is
/// bent a second time. Looked up where the ray leaves, it is right to the texel.
#[test]
fn normals_in_a_cube_are_those_of_the_ray_or_of_the_place() {
    let gpu = Gpu::open(None).unwrap();
    for eta in [1.309, 1.5] {
        let one = mean_angle_deg(&gpu, eta, "one-interface", &[]);
        let direction = mean_angle_deg(&gpu, eta, "normal-cube", &[]);
        let position = mean_angle_deg(&gpu, eta, "normal-cube", &[("lookup", "position")]);
        assert!((direction - one).abs() < 0.02, "{direction} {one}");
        assert!(position < 0.35, "{position}");
    }
}
