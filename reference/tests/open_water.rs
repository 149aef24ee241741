//! Water without a bottom: light goes through it from infinity, and what lies
//! infinitely far away is no surface.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{furnace, object};
use glam::{DAffine3, DVec3};
use reference::{Estimator, Level, Request, render};
use scenes::scene::Normals;
use scenes::{Camera, LayerName, MediumId, Object, Rendering, Scene, Shape, Surface};
use test_support::view;

const LAYERS: [LayerName; 3] = [LayerName::Radiance, LayerName::Truncated, LayerName::Events];

fn water() -> Object {
    object(Shape::HalfSpace, 1, Normals::Flat)
}

fn looking(scene: Scene, eye: [f64; 3], target: [f64; 3]) -> Scene {
    let camera = Camera { eye: eye.into(), target: target.into(), up: DVec3::Z, ..scene.camera };
    Scene { camera, ..scene }
}

fn image(scene: &Scene, level: Level) -> Rendering {
    let mut request = Request::new(view(9, 1, &LAYERS), level);
    request.estimator = Estimator::Tree { cut: 1e-6 };
    render(scene, &request).unwrap()
}

fn data(rendering: &Rendering, layer: LayerName) -> &[f64] {
    &rendering.layers.get(&layer).unwrap().data
}

/// Every value is 1 but for what was cut, and the work is that of a few events a path.
fn assert_white(scene: &Scene, level: Level, most_events: u64) {
    let rendering = image(scene, level);
    let lost = data(&rendering, LayerName::Truncated);
    for (pixel, lost) in data(&rendering, LayerName::Radiance).chunks_exact(3).zip(lost) {
        let wrong = pixel.iter().map(|v| (v + lost - 1.0).abs()).fold(0.0, f64::max);
        assert!(wrong <= 1e-9 && *lost < 1e-3, "{pixel:?} {lost}");
    }
    let events = rendering.counters["events"];
    assert!((1..=most_events).contains(&events), "{events} events in 81 pixels");
    assert_eq!((rendering.counters["capped"], rendering.counters["left_inside"]), (0, 0));
}

#[test]
fn open_water_vanishes_from_above_and_from_below() {
    let scene = furnace(vec![water()], 1.333);
    for level in [Level::R1, Level::R2] {
        let bird = looking(scene.clone(), [0.0, 2.0, 3.0], [0.0, -1.0, 0.0]);
        assert_white(&bird, level, 4 * 81);
        let fish = looking(scene.clone(), [0.0, -1.0, 0.0], [0.0, 1.0, 0.1]);
        assert_white(&fish, level, 4 * 81);
    }
}

#[test]
fn a_ball_under_the_surface_vanishes_too() {
    let mut ball = object(Shape::Sphere { radius_m: 0.5 }, 0, Normals::Flat);
    ball.world_from_object = DAffine3::from_translation(DVec3::new(0.0, -1.0, 0.0));
    ball.surface = Surface::Dielectric { medium: MediumId(0), priority: 1 };
    let scene = furnace(vec![water(), ball], 1.333);
    let scene = looking(scene, [0.0, 2.0, 3.0], [0.0, -1.0, 0.0]);
    assert_white(&scene, Level::R1, 400 * 81);
}

/// The chain through the surface meets it once, and a medium without end that
/// absorbs lets nothing through.
#[test]
fn one_event_and_darkness_where_water_absorbs() {
    let mut scene = furnace(vec![water()], 1.333);
    scene = looking(scene, [0.0, 2.0, 3.0], [0.0, -1.0, 0.0]);
    let clear = image(&scene, Level::R0);
    assert!(data(&clear, LayerName::Events).iter().all(|events| *events == 1.0));
    assert!(data(&clear, LayerName::Radiance).iter().all(|value| *value == 1.0));
    scene.media[1].absorption_per_m = DVec3::new(0.0, 1e-300, 1.0);
    let dark = image(&scene, Level::R0);
    assert!(data(&dark, LayerName::Radiance).chunks_exact(3).all(|v| v == [1.0, 0.0, 0.0]));
}
