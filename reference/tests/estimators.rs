//! The whole tree and random paths are two ways to one number.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{cup, furnace, icosphere, object, torus};
use glam::DVec3;
use reference::{Error, Estimator, Level, Paths, Positions, Request, Restriction, render};
use scenes::environment::{LatLong, Map};
use scenes::scene::Normals;
use scenes::{
    Cube, Dispersion, Environment, LayerName, MediumId, Projection, Scene, Shape, Surface,
};
use std::sync::Arc;
use test_support::view;

fn lit(mut scene: Scene) -> Scene {
    scene.environment = Environment::Map(Arc::new(Map {
        name: "directions".to_owned(),
        lat_long: LatLong { size_px: [1, 1], texels: vec![[0.5; 3]] },
        cube: Cube::from_fn(16, |d| (0.5 + 0.5 * d) * (1.0 + 3.0 * f64::from(u8::from(d.y > 0.6)))),
        rotation_deg: 0.0,
        repaired_texels: 0,
    }));
    scene
}

fn scenes() -> Vec<(&'static str, Scene)> {
    let mesh = |mesh, normals| lit(furnace(vec![object(Shape::Mesh(mesh), 1, normals)], 1.5));
    let mut absorbing = mesh(torus(), Normals::Smooth);
    absorbing.media[1].absorption_per_m = DVec3::new(0.2, 1.0, 4.0);
    let mut bubble = mesh(icosphere(3), Normals::Flat);
    bubble.objects.push(object(Shape::Sphere { radius_m: 0.5 }, 0, Normals::Flat));
    bubble.objects[1].surface = Surface::Dielectric { medium: MediumId(0), priority: 1 };
    let mut dispersive = mesh(icosphere(2), Normals::Smooth);
    dispersive.media[1].dispersion = Dispersion::Cauchy { a: 1.7, b_um2: 0.03 };
    vec![
        ("cup", mesh(cup(), Normals::Flat)),
        ("absorbing", absorbing),
        ("bubble", bubble),
        ("dispersive", dispersive),
    ]
}

/// One ray: an image of a pixel without extent, seen through a point.
fn through(scene: &Scene, target: DVec3) -> Scene {
    let mut scene = scene.clone();
    scene.camera.target = target;
    scene.camera.projection = Projection::Perspective { vertical_fov_deg: 1e-9 };
    scene
}

fn ask(estimator: Estimator, variance: bool) -> Request {
    let mut layers = vec![LayerName::Radiance, LayerName::Truncated];
    if variance {
        layers.push(LayerName::Variance);
    }
    Request { estimator, ..Request::new(view(1, 1, &layers), Level::R1) }
}

/// Distance between tree and paths in units of what both admit.
fn disagreement(scene: &Scene, restriction: Restriction) -> f64 {
    let mut worst = 0.0_f64;
    for i in 0..24_u32 {
        let target = DVec3::new(f64::from(i % 6) * 0.23 - 0.6, f64::from(i / 6) * 0.3 - 0.5, 0.1);
        let scene = through(scene, target);
        let tree = Request { restriction, ..ask(Estimator::Tree { cut: 1e-7 }, false) };
        let tree = render(&scene, &tree).unwrap();
        // What a path does at a split is its own affair: the mean is the same.
        let split = [Paths::default().split, 0.25, 1.0 / 512.0][i as usize % 3];
        let paths = Paths { batches: 32, samples: 256, split, seed: i.into(), ..Paths::default() };
        let paths = render(&scene, &ask(Estimator::Paths(paths), true)).unwrap();
        let data = |r: &scenes::Rendering, name| r.layers.get(&name).unwrap().data.clone();
        let lost = data(&tree, LayerName::Truncated)[0] * 4.0;
        let (a, b) = (data(&tree, LayerName::Radiance), data(&paths, LayerName::Radiance));
        let variance = data(&paths, LayerName::Variance);
        // What none of n paths met happens at most 3 times in n, and carries the
        // weight below which there is chance; no light is brighter than 4.
        let unseen = 3.0 / f64::from(32 * 256) * split * 4.0;
        for channel in 0..3 {
            let bound = 4.5 * variance[channel].sqrt() + lost + unseen + 1e-12;
            worst = worst.max((a[channel] - b[channel]).abs() / bound);
        }
    }
    worst
}

#[test]
fn tree_and_paths_agree_within_what_they_state() {
    for (name, scene) in scenes() {
        let worst = disagreement(&scene, Restriction::default());
        assert!(worst <= 1.0, "{name}: {worst}");
        // The control: a tree of four events is something else.
        let shallow = Restriction { max_interfaces: Some(3), ..Restriction::default() };
        assert!(disagreement(&scene, shallow) > 3.0, "{name}");
    }
}

/// Paths that start where the tree does are on the way to its mean, and random
/// ones to that over the pixel: nine positions are not the same.
#[test]
fn paths_through_the_cells_of_a_pixel_estimate_the_tree_there() {
    let (_, scene) = scenes().swap_remove(0);
    let layers = [LayerName::Radiance, LayerName::Variance, LayerName::Samples];
    let tree = Request::new(view(1, 3, &layers[..1]), Level::R1);
    let tree = render(&scene, &Request { estimator: Estimator::Tree { cut: 1e-7 }, ..tree });
    let value = |r: &scenes::Rendering, name| r.layers.get(&name).unwrap().data[0];
    let tree = value(&tree.unwrap(), LayerName::Radiance);
    let [in_cells, anywhere] = [Positions::Cells, Positions::Random].map(|positions| {
        let paths = Paths { batches: 32, samples: 64, positions, seed: 5, ..Paths::default() };
        let mut request = Request::new(view(1, 3, &layers), Level::R1);
        request.estimator = Estimator::Paths(paths);
        let found = render(&scene, &request).unwrap();
        let count = if positions == Positions::Cells { 9.0 } else { 1.0 };
        assert_eq!(value(&found, LayerName::Samples), 32.0 * 64.0 * count);
        let error = value(&found, LayerName::Radiance) - tree;
        error.abs() / value(&found, LayerName::Variance).sqrt()
    });
    assert!(in_cells < 4.5 && anywhere > 9.0, "{in_cells} {anywhere}");
}

/// Where edges cross pixels, a lattice is closer to the mean over the pixel than
/// as many random positions.
#[test]
fn a_lattice_of_positions_leaves_less_error_than_random_ones() {
    let (_, scene) = scenes().swap_remove(0);
    let found = |estimator, k| {
        let request = Request::new(view(64, k, &[LayerName::Radiance]), Level::R1);
        let rendering = render(&scene, &Request { estimator, ..request }).unwrap();
        rendering.layers.get(&LayerName::Radiance).unwrap().data.clone()
    };
    let mean = found(Estimator::Tree { cut: 1e-3 }, 14);
    for samples in [5, 8, 13, 21] {
        let error = |positions| {
            let paths = Paths { batches: 1, samples, positions, split: 1e-3, seed: 1 };
            let image = found(Estimator::Paths(paths), 1);
            image.iter().zip(&mean).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
        };
        let (lattice, random) = (error(Positions::Lattice), error(Positions::Random));
        assert!(lattice < 0.95 * random, "{samples}: {lattice} {random}");
    }
}

/// The error of 16 batches is what the variance layer says: squared and divided
/// by it, it averages 1.
#[test]
fn the_variance_is_that_of_the_mean() {
    let (_, scene) = scenes().swap_remove(0);
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..60_u32 {
        let scene = through(&scene, DVec3::new(0.01 * f64::from(i) - 0.3, 0.2, 0.0));
        let tree = render(&scene, &ask(Estimator::Tree { cut: 1e-7 }, false)).unwrap();
        let paths = Paths { samples: 4, seed: 100 + u64::from(i), ..Paths::default() };
        let paths = render(&scene, &ask(Estimator::Paths(paths), true)).unwrap();
        let value = |r: &scenes::Rendering, name| r.layers.get(&name).unwrap().data[0];
        let variance = value(&paths, LayerName::Variance);
        if variance > 0.0 {
            let error = value(&tree, LayerName::Radiance) - value(&paths, LayerName::Radiance);
            sum += error * error / variance;
            count += 1.0;
        }
    }
    assert!(count > 30.0);
    assert!((0.5..2.0).contains(&(sum / count)), "{}", sum / count);
}

#[test]
fn a_furnace_has_no_variance() {
    let scene = furnace(vec![object(Shape::Mesh(cup()), 1, Normals::Smooth)], 1.5);
    let layers = [LayerName::Radiance, LayerName::Variance, LayerName::Truncated];
    let mut request = Request::new(view(32, 1, &layers), Level::R1);
    request.estimator = Estimator::Paths(Paths { batches: 2, samples: 4, ..Paths::default() });
    let rendering = render(&scene, &request).unwrap();
    let data = |name| &rendering.layers.get(&name).unwrap().data;
    assert!(data(LayerName::Radiance).iter().all(|v| (v - 1.0).abs() < 1e-12));
    assert!(data(LayerName::Variance).iter().all(|v| *v < 1e-28));
    assert!(data(LayerName::Truncated).iter().all(|v| *v == 0.0));
    assert_eq!(rendering.counters["left_inside"], 0);
}

#[test]
fn bounces_add_up_to_the_image() {
    let (_, scene) = scenes().swap_remove(1);
    let bounces: Vec<LayerName> = (0..800).map(LayerName::Bounce).collect();
    let mut layers = bounces.clone();
    layers.extend([LayerName::Radiance, LayerName::Truncated]);
    let rendering = render(&scene, &Request::new(view(24, 2, &layers), Level::R1)).unwrap();
    let data = |name: &LayerName| &rendering.layers.get(name).unwrap().data;
    for (i, total) in data(&LayerName::Radiance).iter().enumerate() {
        let sum: f64 = bounces.iter().map(|name| data(name)[i]).sum();
        assert!((sum - total).abs() < 1e-3, "{sum} {total}");
    }
    assert!(data(&LayerName::Bounce(1)).iter().any(|v| *v > 0.0));
    assert!(data(&LayerName::Bounce(2)).iter().any(|v| *v > 0.1));
}

#[test]
fn variance_of_a_tree_is_refused() {
    let (_, scene) = scenes().swap_remove(0);
    let answer = render(&scene, &ask(Estimator::Tree { cut: 1e-4 }, true));
    assert_eq!(answer.unwrap_err(), Error::NoVariance);
}
