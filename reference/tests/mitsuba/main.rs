//! Agreement with another renderer, Mitsuba 3, on three glass bodies: within
//! four standard errors in 99.75 % of all pixels, and in the mean.
//!
//! Left out are pixels in or beside which a shading normal was replaced, seen at
//! 4 x 4 positions: Mitsuba keeps those. That is 2 % of the smooth ball and no
//! pixel of the bodies of flat triangles.
//!
//! The test must notice an environment half a texel off, a field of view 0.1
//! degree off, and paths of at most eight edges: else it proves nothing. Each of
//! these differs in that alone from a twin that must agree.
#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "a test may panic, and prints its figures"
)]

#[path = "../common/mod.rs"]
mod common;

use common::{furnace, object};
use glam::DVec3;
use reference::{EnvironmentLookup, Estimator, Level, Paths, Request, render};
use scenes::environment::{LatLong, Map, Repair};
use scenes::image::{read, read_lat_long};
use scenes::layer::flag;
use scenes::scene::Normals;
use scenes::{Environment, LayerName, Layers, Projection, Rendering, Scene, Shape};
use std::path::PathBuf;
use std::sync::{Arc, LazyLock};
use test_support::view;

const SIZE_PX: usize = 256;
/// Their limit on edges of a path; one event less fits on it.
const EDGES: u32 = 256;

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/mitsuba/truth").join(name)
}

fn environment(lat_long: LatLong) -> Environment {
    let map = Map::from_lat_long("no sun", lat_long, 0.0, Some(64), Repair::default());
    Environment::Map(Arc::new(map))
}

fn scene(mesh: &str, normals: Normals) -> Scene {
    let mesh = scenes::obj::read(&file(&format!("{mesh}.obj"))).unwrap().mesh;
    let mut scene = furnace(vec![object(Shape::Mesh(mesh), 1, normals)], 1.5);
    scene.camera.eye = DVec3::new(0.0, 0.6, 4.0);
    scene.camera.projection = Projection::Perspective { vertical_fov_deg: 40.0 };
    scene.environment = environment(read_lat_long(&file("env_nosun_1024x512.exr")).unwrap().0);
    scene
}

fn request(edges: u32, px: usize, layers: &[LayerName]) -> Request {
    let mut request = Request::new(view(px as u32, 1, layers), Level::R1);
    request.environment_lookup = EnvironmentLookup::LatLong;
    request.restriction.max_events = edges - 1;
    request
}

fn ours(scene: &Scene, batches: u32, edges: u32) -> Rendering {
    let mut request = request(edges, SIZE_PX, &[LayerName::Radiance, LayerName::Variance]);
    request.estimator = Estimator::Paths(Paths { batches, samples: 8, ..Paths::default() });
    render(scene, &request).unwrap()
}

/// Mitsuba's image or its standard error.
fn theirs(case: &str, what: &str) -> Vec<f64> {
    let layers = read(&file(&format!("mitsuba_{case}{what}.exr"))).unwrap();
    layers.get(&LayerName::Radiance).unwrap().data.clone()
}

fn data(layers: &Layers, name: LayerName) -> &[f64] {
    &layers.get(&name).unwrap().data
}

#[derive(Debug)]
struct Agreement {
    /// Share of pixels in which every channel agrees.
    pixels: f64,
    /// Difference of the means in standard errors of the mean, worst channel.
    mean: f64,
    /// Share of pixels left out.
    flagged: f64,
}

impl Agreement {
    fn holds(&self) -> bool {
        self.pixels >= 0.9975 && self.mean <= 4.0 && self.flagged <= 0.05
    }
}

/// Pixels in which our policy on normals acted, and their neighbours.
fn flagged(scene: &Scene) -> Vec<bool> {
    const FINE: usize = 4;
    let wide = FINE * SIZE_PX;
    let fine = render(scene, &request(EDGES, wide, &[LayerName::Flags])).unwrap();
    let mut here = vec![false; SIZE_PX * SIZE_PX];
    for (i, flags) in data(&fine.layers, LayerName::Flags).iter().enumerate() {
        let (x, y) = (i % wide / FINE, i / wide / FINE);
        here[y * SIZE_PX + x] |= *flags as u32 & flag::GEOMETRIC_NORMAL != 0;
    }
    let around = |i: usize| i.saturating_sub(1)..(i + 2).min(SIZE_PX);
    let pixels = (0..SIZE_PX * SIZE_PX).map(|i| (i % SIZE_PX, i / SIZE_PX));
    pixels.map(|(px, py)| around(py).any(|y| around(px).any(|x| here[y * SIZE_PX + x]))).collect()
}

fn compare(rendering: &Rendering, case: &str, skip: &[bool]) -> Agreement {
    let (image, error) = (theirs(case, ""), theirs(case, ".stderr"));
    let mine = data(&rendering.layers, LayerName::Radiance);
    let own = data(&rendering.layers, LayerName::Variance);
    let (mut agree, mut counted) = (0, 0);
    let (mut difference, mut variance) = (DVec3::ZERO, DVec3::ZERO);
    for pixel in (0..SIZE_PX * SIZE_PX).filter(|pixel| !skip[*pixel]) {
        let mut all = true;
        for channel in 0..3 {
            let i = 3 * pixel + channel;
            let d = mine[i] - image[i];
            let both = error[i] * error[i] + own[i];
            all &= d.abs() <= 4.0 * both.sqrt();
            difference[channel] += d;
            variance[channel] += both;
        }
        agree += usize::from(all);
        counted += 1;
    }
    let share = |n: usize, of: usize| n as f64 / of as f64;
    Agreement {
        pixels: share(agree, counted),
        mean: (difference.abs() / variance.map(f64::sqrt)).max_element(),
        flagged: share(SIZE_PX * SIZE_PX - counted, SIZE_PX * SIZE_PX),
    }
}

fn agreement(case: &str, normals: Normals) -> Agreement {
    let scene = scene(case, normals);
    let found = compare(&ours(&scene, 32, EDGES), case, &flagged(&scene));
    eprintln!("{case}: {found:?}");
    found
}

#[test]
fn a_ball_of_flat_triangles_looks_as_in_mitsuba() {
    let found = agreement("sphere5k_flat", Normals::Flat);
    assert!(found.holds(), "{found:?}");
}

#[test]
fn a_ball_with_smooth_normals_looks_as_in_mitsuba_where_no_normal_was_replaced() {
    let found = agreement("sphere5k_smooth", Normals::Smooth);
    assert!(found.holds(), "{found:?}");
}

#[test]
fn a_cup_that_traps_light_looks_as_in_mitsuba() {
    let found = agreement("cup_flat", Normals::Flat);
    assert!(found.holds(), "{found:?}");
}

/// The cup with something perturbed, judged as its twin: the same mask, batches and paths.
fn perturbed(what: &str, edges: u32, perturb: impl FnOnce(&mut Scene)) -> Agreement {
    static MASK: LazyLock<Vec<bool>> = LazyLock::new(|| flagged(&scene("cup_flat", Normals::Flat)));
    let mut scene = scene("cup_flat", Normals::Flat);
    perturb(&mut scene);
    let found = compare(&ours(&scene, 16, edges), "cup_flat", &MASK);
    eprintln!("{what}: {found:?}");
    found
}

/// The twin of every control below: nothing perturbed, and it agrees.
#[test]
fn the_twin_of_the_controls_agrees() {
    let found = perturbed("twin", EDGES, |_| ());
    assert!(found.holds(), "{found:?}");
}

#[test]
fn an_environment_half_a_texel_off_is_noticed() {
    let found = perturbed("half a texel off", EDGES, |scene| {
        if let Environment::Map(map) = &mut scene.environment {
            let mut turned = Map::clone(map);
            turned.rotation_deg = 0.5 * 360.0 / f64::from(map.lat_long.size_px[0]);
            *map = Arc::new(turned);
        }
    });
    assert!(!found.holds(), "{found:?}");
}

#[test]
fn a_field_of_view_a_tenth_of_a_degree_off_is_noticed() {
    let found = perturbed("field of view off", EDGES, |scene| {
        scene.camera.projection = Projection::Perspective { vertical_fov_deg: 40.1 };
    });
    assert!(!found.holds(), "{found:?}");
}

/// Paths cut off at eight edges lose light also where the twin agrees.
#[test]
fn paths_of_at_most_eight_edges_are_noticed() {
    let found = perturbed("eight edges", 8, |_| ());
    assert!(!found.holds(), "{found:?}");
}
