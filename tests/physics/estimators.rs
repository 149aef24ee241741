//! The whole tree and random paths agree on every built-in scene, within what
//! each states of itself. The environment is smooth, so that a few thousand
//! paths know their own variance.

#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use glam::DVec3;
use reference::{Estimator, Level, Paths, Request};
use scenes::environment::{LatLong, Map};
use scenes::{Camera, Cube, Environment, LayerName, Scene};
use std::sync::Arc;
use test_support::{ray, view};

/// Brightest radiance of the environment and of every light in these scenes.
const BRIGHTEST: f64 = 10.0;
const SAMPLES: u32 = 64;
/// Weight below which paths follow one of two ways at random.
const LEFT_TO_CHANCE: f64 = 1.0 / 32.0;

fn smooth() -> Environment {
    Environment::Map(Arc::new(Map {
        name: "directions".to_owned(),
        lat_long: LatLong { size_px: [1, 1], texels: vec![[0.5; 3]] },
        cube: Cube::from_fn(16, |d| 0.5 + 0.5 * d),
        rotation_deg: 0.0,
        repaired_texels: 0,
    }))
}

/// The camera's ray through a place of the image, and nothing around it.
fn one_ray(camera: &Camera, at: [f64; 2]) -> Camera {
    let [width, height] = camera.resolution_px.map(f64::from);
    let through = camera.ray_through(glam::DVec2::new(at[0] * width, at[1] * height));
    ray(through.origin, through.direction)
}

fn radiance(scene: &Scene, estimator: Estimator) -> (DVec3, DVec3) {
    let spread = match estimator {
        Estimator::Tree { .. } => LayerName::Truncated,
        Estimator::Paths(_) => LayerName::Variance,
    };
    let layers = [LayerName::Radiance, spread.clone()];
    let request = Request { estimator, ..Request::new(view(1, 1, &layers), Level::R2) };
    let rendering = reference::render(scene, &request).unwrap();
    let data = |name| &rendering.layers.get(&name).unwrap().data;
    let spread = data(spread);
    let spread =
        if spread.len() == 3 { DVec3::from_slice(spread) } else { DVec3::splat(spread[0]) };
    (DVec3::from_slice(data(LayerName::Radiance)), spread)
}

/// Largest difference over both bounds, for rays across the image.
fn disagreement(scene: &Scene, change: f64) -> f64 {
    let mut worst = 0.0_f64;
    for (i, at) in [[0.5, 0.5], [0.42, 0.55], [0.58, 0.6], [0.47, 0.4]].into_iter().enumerate() {
        let scene = Scene { camera: one_ray(&scene.camera, at), ..scene.clone() };
        let (tree, lost) = radiance(&scene, Estimator::Tree { cut: 1e-6 });
        let seed = 1 + i as u64;
        let (paths, variance) = radiance(
            &scene,
            Estimator::Paths(Paths { batches: 32, samples: SAMPLES, seed, ..Paths::default() }),
        );
        // Of 32 batches one in ten thousand lies beyond 4.5. What none of n paths met
        // happens at most 3 times in n, and carries what is left to chance.
        let unseen = 3.0 / f64::from(32 * SAMPLES) * LEFT_TO_CHANCE * BRIGHTEST;
        let bound = 4.5 * variance.map(f64::sqrt) + BRIGHTEST * lost + unseen;
        worst = worst.max(((tree * change - paths).abs() / bound).max_element());
    }
    worst
}

#[test]
fn tree_and_paths_agree_on_every_built_in_scene() {
    let mut seen = 0;
    for builtin in scenes::builtins() {
        let mut scene = match builtin.load() {
            Ok(scene) => scene,
            Err(scenes::Error::MissingAsset { .. }) => continue,
            Err(error) => panic!("{}: {error}", builtin.name),
        };
        scene.environment = smooth();
        let found = disagreement(&scene, 1.0);
        assert!(found <= 1.0, "{}: {found}", builtin.name);
        seen += 1;
    }
    assert!(seen >= 15, "{seen}");
    // The control: light that is a tenth too strong is noticed.
    let mut scene = scenes::builtin("teapot").unwrap();
    scene.environment = smooth();
    assert!(disagreement(&scene, 1.1) > 1.0);
}
