//! A lossless body in uniform light cannot be seen: every pixel is 1 within
//! what was reported as dropped.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{furnace, meshes, object};
use reference::{Estimator, Level, Request, render};
use scenes::layer::flag;
use scenes::scene::Normals;
use scenes::{LayerName, Rendering, Shape};
use test_support::view;

fn white(rendering: &Rendering) -> (f64, f64, Vec<f64>) {
    let radiance = &rendering.layers.get(&LayerName::Radiance).unwrap().data;
    let truncated = &rendering.layers.get(&LayerName::Truncated).unwrap().data;
    let (mut over, mut under) = (0.0_f64, 0.0_f64);
    for (pixel, lost) in radiance.chunks_exact(3).zip(truncated) {
        for value in pixel {
            over = over.max(value - 1.0);
            under = under.max(1.0 - lost - value);
        }
    }
    (over, under, truncated.clone())
}

#[test]
fn every_body_vanishes_in_uniform_light() {
    for (name, mesh) in meshes() {
        for normals in [Normals::Flat, Normals::Smooth] {
            for eta in [1.05, 1.5, 2.4] {
                let scene = furnace(vec![object(Shape::Mesh(mesh.clone()), 1, normals)], eta);
                let layers = [LayerName::Radiance, LayerName::Truncated];
                let mut request = Request::new(view(64, 2, &layers), Level::R1);
                request.estimator = Estimator::Tree { cut: 1e-4 };
                let rendering = render(&scene, &request).unwrap();
                let (over, under, _) = white(&rendering);
                assert!(over <= 1e-9 && under <= 1e-9, "{name} {normals:?} {eta}: {over} {under}");
                assert_eq!(rendering.counters["left_inside"], 0);
            }
        }
    }
}

#[test]
fn at_a_fine_cut_almost_nothing_is_dropped() {
    for (name, mesh) in meshes() {
        for normals in [Normals::Flat, Normals::Smooth] {
            let scene = furnace(vec![object(Shape::Mesh(mesh.clone()), 1, normals)], 1.5);
            let layers = [LayerName::Radiance, LayerName::Truncated];
            let mut request = Request::new(view(64, 2, &layers), Level::R1);
            request.estimator = Estimator::Tree { cut: 1e-6 };
            let rendering = render(&scene, &request).unwrap();
            let (over, under, mut truncated) = white(&rendering);
            truncated.sort_by(f64::total_cmp);
            let (most, nearly) =
                (truncated[truncated.len() - 1], truncated[truncated.len() * 999 / 1000]);
            assert!(over <= 1e-9 && under <= 1e-9);
            assert!(nearly <= 1e-4 && most <= 1e-3, "{name} {normals:?}");
        }
    }
}

/// The control: without reflections off the inside the body is seen at once,
/// and nothing claims to have been dropped for it.
#[test]
fn dropping_a_branch_breaks_the_furnace() {
    let body = object(Shape::Mesh(common::icosphere(2)), 1, Normals::Flat);
    let mut request =
        Request::new(view(32, 1, &[LayerName::Radiance, LayerName::Truncated]), Level::R1);
    request.restriction.internal_reflection = false;
    let (_, under, _) = white(&render(&furnace(vec![body], 1.5), &request).unwrap());
    assert!(under > 0.03, "{under}");
}

/// In a ball of index 1.5 seen along its axis the chain runs 2 radii of glass,
/// and Beer's law takes exp(-2 sigma) of it.
#[test]
fn lengths_and_absorption_follow_the_chain() {
    let mut scene = furnace(vec![object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat)], 1.5);
    scene.media[1].absorption_per_m = glam::DVec3::new(0.0, 0.5, 3.0);
    let layers = [
        LayerName::Radiance,
        LayerName::Path("glass".to_owned()),
        LayerName::Path("vacuum".to_owned()),
    ];
    let rendering = render(&scene, &Request::new(view(1, 1, &layers), Level::R0)).unwrap();
    let [radiance, glass, vacuum] = [0, 1, 2].map(|i| &rendering.layers.list[i].data);
    assert!((glass[0] - 2.0).abs() < 1e-12);
    assert!((vacuum[0] - (scene.camera.eye.length() - 1.0)).abs() < 1e-12);
    for (channel, sigma) in [0.0_f64, 0.5, 3.0].into_iter().enumerate() {
        assert!((radiance[channel] - (-2.0 * sigma).exp()).abs() < 1e-12, "{radiance:?}");
    }
}

/// Where interpolated normals trap a chain it starts again, and what it came through
/// since is forgotten by every layer alike: Beer's law ties lengths to radiance.
#[test]
fn a_chain_that_starts_again_counts_only_the_way_it_took() {
    let sigma = 0.5;
    let image = |most| {
        let mut scene = furnace(vec![object(Shape::Mesh(common::cup()), 1, Normals::Smooth)], 1.5);
        scene.media[1].absorption_per_m = glam::DVec3::splat(sigma);
        let path = LayerName::Path("glass".to_owned());
        let layers = [LayerName::Radiance, path, LayerName::TotalReflections, LayerName::Flags];
        let mut request = Request::new(view(96, 1, &layers), Level::R0);
        request.restriction.max_events = most;
        let layers = render(&scene, &request).unwrap().layers;
        layers.list.into_iter().map(|layer| layer.data).collect::<Vec<_>>()
    };
    // 60 events are fewer than a path is patient: what they do not let out is trapped.
    let [all, short] = [20_000, 60].map(image);
    let lost = |flags: &f64| *flags as u32 & flag::LOST != 0;
    let trapped: Vec<usize> = (0..all[3].len()).filter(|i| lost(&short[3][*i])).collect();
    assert!(!trapped.is_empty());
    for (pixel, length_m) in all[1].iter().enumerate() {
        assert!(!lost(&all[3][pixel]));
        let radiance = (-sigma * length_m).exp();
        assert!((all[0][3 * pixel] - radiance).abs() < 1e-12, "{pixel}: {length_m} m");
    }
    let patient = trapped.iter().filter(|i| all[2][**i] < 60.0).count();
    assert!(patient > 0, "{} chains were trapped, and none got out early", trapped.len());
}

/// A layer that is asked for twice is there once, and takes nobody else's place.
#[test]
fn a_layer_may_be_asked_for_twice() {
    let scene = furnace(vec![object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat)], 1.5);
    let path = |medium: &str| LayerName::Path(medium.to_owned());
    let lengths = |layers: &[LayerName]| {
        let request = Request::new(view(1, 1, layers), Level::R0);
        let layers = render(&scene, &request).unwrap().layers;
        layers.list.iter().map(|layer| (layer.name.clone(), layer.data[0])).collect::<Vec<_>>()
    };
    let once = lengths(&[path("glass"), path("vacuum")]);
    assert!((once[0].1 - 2.0).abs() < 1e-12);
    assert!((once[1].1 - (scene.camera.eye.length() - 1.0)).abs() < 1e-12);
    assert_eq!(lengths(&[path("glass"), path("glass"), path("vacuum")]), once);
}

/// After the last interface that counts light comes straight from the environment,
/// and nothing more is absorbed.
#[test]
fn what_lies_beyond_the_last_interface_absorbs_nothing() {
    let mut scene = furnace(vec![object(Shape::Sphere { radius_m: 1.0 }, 1, Normals::Flat)], 1.5);
    scene.media[1].absorption_per_m = glam::DVec3::splat(0.5);
    let radiance = |most| {
        let mut request = Request::new(view(1, 1, &[LayerName::Radiance]), Level::R0);
        request.restriction.max_interfaces = most;
        render(&scene, &request).unwrap().layers.list[0].data[0]
    };
    assert!((radiance(Some(1)) - 1.0).abs() < 1e-12, "{}", radiance(Some(1)));
    let through = (-1.0_f64).exp();
    for most in [Some(2), None] {
        assert!((radiance(most) - through).abs() < 1e-12, "{most:?}: {}", radiance(most));
    }
}
