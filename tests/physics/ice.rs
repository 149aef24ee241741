//! Cracks end where the body ends: the image-space clip against the exact mask.

#![allow(clippy::unwrap_used, reason = "a failing test may panic")]
#![allow(clippy::print_stderr, reason = "prints the rates that are documented")]

use reference::Level;
use scenes::scene::Crack;
use scenes::{LayerName, Scene, View};

const SIZE_PX: u32 = 256;

fn view() -> View {
    test_support::view(SIZE_PX, 1, &[LayerName::Buffer("crack_mask".into())])
}

fn cracked(name: &str) -> Scene {
    let mut scene = scenes::builtin(name).unwrap();
    scene.objects[0].crack = Some(Crack { count: 2, grid: 24, seed: 5 });
    scene
}

fn drawn(gpu: &realtime::Gpu, scene: &Scene, parameters: &[(&str, &str)]) -> Vec<bool> {
    let request = realtime::Request {
        parameters: test_support::parameters(parameters),
        ..realtime::Request::new(view(), "blended", realtime::Keep::Needed)
    };
    mask(&realtime::render(gpu, scene, &request).unwrap().layers)
}

fn exact(scene: &Scene) -> Vec<bool> {
    let request = reference::Request::new(view(), Level::R0);
    mask(&reference::render(scene, &request).unwrap().layers)
}

fn mask(layers: &scenes::Layers) -> Vec<bool> {
    let layer = layers.get(&LayerName::Buffer("crack_mask".into())).unwrap();
    layer.data.iter().map(|value| *value > 0.5).collect()
}

/// How a mask differs from the exact one.
#[derive(Debug)]
struct Rates {
    /// Shares of all pixels.
    false_positive: f64,
    false_negative: f64,
    /// Intersection over union.
    iou: f64,
}

fn rates(drawn: &[bool], exact: &[bool]) -> Rates {
    let count = |of: fn(bool, bool) -> bool| {
        drawn.iter().zip(exact).filter(|(d, e)| of(**d, **e)).count() as f64
    };
    let pixels = drawn.len() as f64;
    Rates {
        false_positive: count(|d, e| d && !e) / pixels,
        false_negative: count(|d, e| !d && e) / pixels,
        iou: count(|d, e| d && e) / count(|d, e| d || e),
    }
}

/// The depth interval is exact on bodies without hollows; in a hollow it shows
/// cracks that are not there, and never misses one. All layers, and sheets that
/// were cut beforehand, are exact but for single pixels at edges.
#[test]
fn cracks_are_clipped_by_the_body() {
    let gpu = realtime::Gpu::open(None).unwrap();
    for (name, convex) in [("ball", true), ("ice-cube", true), ("cup", false), ("teapot", false)] {
        let scene = cracked(name);
        let exact = exact(&scene);
        let clipped = |clip| rates(&drawn(&gpu, &scene, &[("clip", clip)]), &exact);
        let [depth, layers, mesh, none] = ["depth", "layers", "mesh", "none"].map(clipped);
        eprintln!("{name}: depth {depth:?}\n  layers {layers:?}\n  mesh {mesh:?}\n  none {none:?}");
        assert!(depth.false_negative < 1e-4 && layers.iou > 0.999, "{name}");
        assert!((depth.iou > 0.999) == convex, "{name}: {depth:?}");
        // The control: without a clip the mask is wrong.
        assert!(none.false_positive > 0.1, "{name}: {none:?}");
        assert!(mesh.iou > 0.999, "{name}: {mesh:?}");
    }
}

/// Planes that fit the body make a 16-bit depth serve; a depth in floating point
/// does not care.
#[test]
fn a_coarse_depth_needs_planes_that_fit() {
    let gpu = realtime::Gpu::open(None).unwrap();
    let scene = cracked("ball");
    let exact = exact(&scene);
    let wrong = |format, planes| {
        let parameters = [("depth_format", format), ("depth_planes", planes)];
        let found = rates(&drawn(&gpu, &scene, &parameters), &exact);
        ((found.false_positive + found.false_negative) * f64::from(SIZE_PX * SIZE_PX)).round()
    };
    assert_eq!([wrong("float", "fitted"), wrong("float", "default")], [0.0, 0.0]);
    let [fitted, default] = [wrong("16-bit", "fitted"), wrong("16-bit", "default")];
    eprintln!("16 bits: {fitted} pixels wrong with fitted planes, {default} with 0.1 to 1000 m");
    assert!(default >= 10.0 * fitted.max(1.0), "{fitted} {default}");
}
