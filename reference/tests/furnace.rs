//! A lossless body in uniform light cannot be seen: every pixel is 1 within
//! what was reported as dropped.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod common;

use common::{furnace, meshes, object, view};
use reference::{Estimator, Level, Request, render};
use scenes::scene::Normals;
use scenes::{LayerName, Rendering, Shape};

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
