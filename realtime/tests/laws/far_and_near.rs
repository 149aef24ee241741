//! A body is seen wherever it is, however far or near something else is.

use crate::*;

const SIZE_PX: [u32; 2] = [48, 48];

/// A ball of triangles, radius 1, about a point.
fn ball(at: DVec3) -> Object {
    let mesh = scenes::generate::builtin("geodesic-16").unwrap();
    let world_from_object = DAffine3::from_translation(at);
    Object { world_from_object, ..body(Shape::Mesh(mesh)) }
}

/// Pixels in which light met an interface, and those whose rays come within a ball's radius of 1
/// about a point: a mesh inside of it covers nearly as many.
fn covered_and_expected(scene: &Scene, method: &str, centre: DVec3) -> (f64, f64) {
    let request = request(scene, method, &[LayerName::Events]);
    let rendering = realtime::render(&GPU, scene, &request).unwrap();
    let events = &rendering.layers.get(&LayerName::Events).unwrap().data;
    let met = events.iter().filter(|count| **count > 0.0).count();
    let meets = |ray: &scenes::Ray| {
        let along = (centre - ray.origin).dot(ray.direction);
        (ray.origin + along * ray.direction - centre).length() < 1.0
    };
    let expected = centre_rays(&scene.camera).iter().filter(|ray| meets(ray)).count();
    (met as f64, expected as f64)
}

#[track_caller]
fn assert_seen(scene: &Scene, method: &str) {
    let (covered, expected) = covered_and_expected(scene, method, DVec3::ZERO);
    assert!(
        expected > 100.0 && covered > 0.9 * expected && covered <= expected,
        "{covered} {expected}"
    );
}

/// The near plane was a thousandth of the radius of everything in front of the eye.
#[test]
fn a_floor_of_ten_kilometres_hides_no_ball_above_it() {
    let mut scene = test_support::scene(
        vec![ball(DVec3::ZERO)],
        1.5,
        perspective(DVec3::new(0.0, 0.9, 4.4), SIZE_PX),
    );
    assert_seen(&scene, "one-interface");
    let mut floor = body(Shape::Box { half_extent_m: DVec3::new(5e3, 0.5, 5e3) });
    floor.world_from_object = DAffine3::from_translation(DVec3::new(0.0, -2.0, 0.0));
    floor.surface = Surface::Unlit { radiance: scenes::scene::Paint::Constant(DVec3::splat(0.2)) };
    scene.objects.push(floor);
    for method in ["one-interface", "two-interface", "multi"] {
        assert_seen(&scene, method);
    }
}

#[test]
fn a_second_body_far_away_hides_no_first() {
    let mut scene = test_support::scene(
        vec![ball(DVec3::ZERO)],
        1.5,
        perspective(DVec3::new(0.0, 0.0, 4.4), SIZE_PX),
    );
    // Behind the eye, where it covers no pixel.
    scene.objects.push(ball(DVec3::new(0.0, 0.0, 1e5)));
    for method in ["one-interface", "two-interface", "multi"] {
        assert_seen(&scene, method);
    }
}

/// A pane that the eye nearly touches fills the image.
#[test]
fn a_pane_from_six_millimetres_is_seen() {
    let half_extent_m = DVec3::new(5.0, 5.0, 0.002);
    let camera = perspective(DVec3::new(0.0, 0.0, 0.008), SIZE_PX);
    let scene = scene_of(Shape::Box { half_extent_m }, 1.5, camera);
    let request = request(&scene, "one-interface", &[LayerName::Coverage]);
    let rendering = realtime::render(&GPU, &scene, &request).unwrap();
    let coverage = &rendering.layers.get(&LayerName::Coverage).unwrap().data;
    assert!(coverage.iter().all(|share| *share == 1.0));
}
