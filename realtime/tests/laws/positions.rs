//! Positions within a pixel: k x k frames, each seen by a camera that is shifted.

use crate::*;
use realtime::Timing;
use scenes::Layers;

/// At k x k positions.
fn at(request: &Request, k: u32) -> Request {
    let mut request = request.clone();
    request.view.positions_per_axis = k;
    request
}

fn rendered(scene: &Scene, request: &Request) -> Layers {
    realtime::render(&GPU, scene, request).unwrap().layers
}

/// k x k positions are those of the exact renderer: a pixel's mean coverage is
/// the share of its positions whose rays meet the ball.
#[test]
fn positions_lie_where_they_are_stated_to_lie() {
    let camera = parallel(2.1, [24, 24]);
    let scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, camera);
    let mut request = request(&scene, "undeviated", &[LayerName::Coverage]);
    request.view.positions_per_axis = 4;
    let rendering = realtime::render(&GPU, &scene, &request).unwrap();
    let coverage = &rendering.layers.list[0].data;
    for (pixel, share) in coverage.iter().enumerate() {
        let corner = glam::DVec2::new((pixel % 24) as f64, (pixel / 24) as f64);
        let at = |i: u32| glam::DVec2::new(f64::from(i % 4), f64::from(i / 4)) + 0.5;
        let rays = (0..16).map(|i| camera.ray_through(corner + at(i) / 4.0));
        let met = rays.filter(|ray| ray.origin.truncate().length() < 1.0).count();
        assert_eq!(*share, met as f64 / 16.0, "pixel {pixel}");
    }
}

/// The mean over the k x k pixels of a frame k times as large that make one.
fn boxed(large: &[f64], width: usize, k: usize, channels: usize) -> Vec<f64> {
    let height = large.len() / (channels * k * k * width);
    let mut means = vec![0.0; channels * width * height];
    for (i, value) in large.iter().enumerate() {
        let (pixel, channel) = (i / channels, i % channels);
        let (x, y) = (pixel % (k * width) / k, pixel / (k * width) / k);
        means[channels * (y * width + x) + channel] += value / (k * k) as f64;
    }
    means
}

/// A method that reads nothing but its own pixel sees k x k shifted frames as one
/// that is k times as large; shifts that are wrong by one position are noticed.
#[test]
fn shifted_frames_are_the_pixels_of_a_larger_one_where_nothing_else_is_read() {
    for camera in [parallel(2.1, [24, 16]), perspective(DVec3::new(1.0, 0.7, 4.0), [24, 16])] {
        for method in ["one-interface", "blended"] {
            let mut scene = scene_of(Shape::Sphere { radius_m: 0.9 }, 1.5, camera);
            scene.environment = crate::plans::environments()[1].clone();
            let asked = request(&scene, method, &[LayerName::Radiance]);
            let small = rendered(&scene, &at(&asked, 4)).list[0].data.clone();
            let mut large = asked.clone();
            large.view.resolution_px = [96, 64];
            let large = rendered(&scene, &large).list[0].data.clone();
            let off = |wanted: &[f64]| {
                let pairs = small.iter().zip(wanted);
                pairs.map(|(a, b)| (a - b).abs() / (0.01 + b)).fold(0.0, f64::max)
            };
            let (wanted, other) = (boxed(&large, 24, 4, 3), moved(&large));
            assert!(off(&wanted) < 1e-3, "{method}: {}", off(&wanted));
            assert!(off(&boxed(&other, 24, 4, 3)) > 1e-2, "{method}");
        }
    }
}

/// The same image, moved by one column: as if every shift were wrong by one
/// position.
fn moved(large: &[f64]) -> Vec<f64> {
    let mut moved = large[3..].to_vec();
    moved.extend_from_slice(&large[..3]);
    moved
}

/// An image of layers looks at them as finely as the frame that is timed: both
/// images are the same where they are drawn at the same position, and k x k
/// positions need the memory of one.
#[test]
fn positions_need_the_memory_of_one_frame() {
    let scene = scenes::builtin("teapot").unwrap();
    for method in ["multi", "two-interface", "blended"] {
        let mut asked = request(&scene, method, &[LayerName::Radiance]);
        asked.view.resolution_px = [48, 36];
        let run = |k| realtime::render(&GPU, &scene, &at(&asked, k)).unwrap();
        let [one, many] = [run(1), run(3)];
        let slack = many.counters["layer_bytes"] - one.counters["layer_bytes"];
        assert_eq!(many.counters["bytes"], one.counters["bytes"] + slack, "{method}");
        assert_eq!(many.counters["passes"], 9 * one.counters["passes"], "{method}");
        assert_eq!(many.plan.passes.len() as u64, many.counters["passes"], "{method}");
        assert!(one.layers != many.layers, "{method}");
    }
}

/// The middle one of 3 x 3 positions is the pixel's centre: with the eight others
/// taken away, the same bits.
#[test]
fn the_middle_position_is_the_centre_and_every_run_has_the_same_bits() {
    let scene = scenes::builtin("teapot").unwrap();
    let mut asked = request(&scene, "multi", &[LayerName::Radiance, LayerName::Exit]);
    asked.view.resolution_px = [40, 32];
    let [first, second] = [3, 3].map(|k| rendered(&scene, &at(&asked, k)));
    assert_eq!(first, second);
    let exit = |layers: &Layers| layers.get(&LayerName::Exit).unwrap().data.clone();
    assert_eq!(exit(&first), exit(&rendered(&scene, &at(&asked, 1))));
    // Timing more positions changes no image.
    let timing =
        Timing { warm_up: 0, seconds: 0.0, min_frames: 1, max_frames: 1, positions_per_axis: 2 };
    asked.timing = Some(timing);
    assert_eq!(first, rendered(&scene, &at(&asked, 3)));
}
