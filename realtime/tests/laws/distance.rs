//! The guessed distance of `two-interface` goes to that along the view as the
//! index goes to 1, and to that along the normal as it grows without end. On a
//! ball exchanged weights look better; only the limits tell them apart.

use crate::*;

/// Second hits, metres, with one of the ways to guess the distance.
fn second_hits(eta: f64, distance: &str) -> Vec<DVec3> {
    let half_extent_m = DVec3::new(0.5, 0.3, 0.7);
    let camera = perspective(DVec3::new(1.6, 1.1, 2.9), [64, 64]);
    let scene = scene_of(Shape::Box { half_extent_m }, eta, camera);
    let request = request(&scene, "two-interface", &[LayerName::Hit2]);
    let request = with(request, &[("distance", distance)]);
    let rendering = realtime::render(&GPU, &scene, &request).unwrap();
    vectors(&rendering.layers, &LayerName::Hit2)
}

fn mean_distance_m(a: &[DVec3], b: &[DVec3]) -> f64 {
    let both = a.iter().zip(b).filter(|(a, b)| **a != DVec3::ZERO && **b != DVec3::ZERO);
    let (sum, count) = both.fold((0.0, 0.0), |(s, n), (a, b)| (s + a.distance(*b), n + 1.0));
    assert!(count > 200.0, "{count}");
    sum / count
}

#[test]
fn the_weights_are_right_at_both_ends() {
    let apart =
        |eta, other| mean_distance_m(&second_hits(eta, "weighted"), &second_hits(eta, other));
    let [weak_view, weak_normal] = ["view", "normal"].map(|other| apart(1.001, other));
    let [strong_view, strong_normal] = ["view", "normal"].map(|other| apart(1000.0, other));
    assert!(weak_view < 2e-3 && weak_normal > 0.05, "{weak_view} {weak_normal}");
    assert!(strong_normal < 2e-3 && strong_view > 0.05, "{strong_normal} {strong_view}");
}
