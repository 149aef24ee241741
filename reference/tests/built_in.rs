//! Every closed built-in mesh vanishes in uniform light, with flat and with smooth
//! normals, from the weakest to the strongest glass, within what is reported as
//! dropped; and no path leaves while it counts itself inside.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test may panic, and prints its figures"
)]

mod common;

use common::{furnace, object, view};
use reference::{Estimator, Level, Request, render};
use scenes::generate::builtin;
use scenes::scene::Normals;
use scenes::{LayerName, Shape};

const CLOSED: [&str; 20] = [
    "sphere-960",
    "geodesic-16",
    "ice-cube",
    "teapot",
    "cup",
    "mug",
    "brilliant",
    "shell",
    "bubble-ball",
    "nested-shells",
    "torus",
    "half-ball",
    "lens",
    "prism",
    "cube",
    "corner-cube",
    "gear",
    "thin-wall",
    "slivers",
    "edge-to-edge",
];

/// Furnace at one resolution and cut; prints what was dropped.
fn all_vanish(edge_px: u32, cut: f64, etas: &[f64]) {
    for name in CLOSED {
        for eta in etas {
            let mut dropped = Vec::new();
            for normals in [Normals::Flat, Normals::Smooth] {
                let body = object(Shape::Mesh(builtin(name).unwrap()), 1, normals);
                let scene = furnace(vec![body], *eta);
                let layers = [LayerName::Radiance, LayerName::Truncated];
                let mut request = Request::new(view(edge_px, 1, &layers), Level::R1);
                request.estimator = Estimator::Tree { cut };
                let rendering = render(&scene, &request).unwrap();
                let data = |name| &rendering.layers.get(&name).unwrap().data;
                let truncated = data(LayerName::Truncated);
                let case = format!("{name} {normals:?} {eta}");
                for (light, lost) in data(LayerName::Radiance).chunks_exact(3).zip(truncated) {
                    let short = 1.0 - light[0];
                    assert!(short <= lost + 1e-9 && short >= -1e-9, "{case}: {light:?} {lost}");
                }
                assert_eq!(rendering.counters["left_inside"], 0, "{case}");
                dropped.extend(truncated.iter().copied());
            }
            dropped.sort_by(f64::total_cmp);
            let at = |share: f64| dropped[((dropped.len() - 1) as f64 * share) as usize];
            let [half, most, nearly, all] = [0.5, 0.99, 0.999, 1.0].map(at);
            eprintln!(
                "{name} {eta}: dropped {half:.1e} (50 %) {most:.1e} (99 %) {nearly:.1e} (99.9 %) {all:.1e}"
            );
        }
    }
}

#[test]
fn closed_meshes_vanish() {
    all_vanish(24, 1e-4, &[1.05, 1.5, 2.4]);
}

#[test]
#[ignore = "minutes"]
fn closed_meshes_vanish_at_a_fine_cut() {
    all_vanish(64, 1e-6, &[1.05, 1.309, 1.5, 2.0, 2.4]);
}
