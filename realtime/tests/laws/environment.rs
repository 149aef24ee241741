//! Light from infinity is looked up as the CPU does it.

use crate::*;
use scenes::Cube;
use scenes::environment::{LatLong, Map};

fn map(cube: Cube) -> Map {
    let lat_long = LatLong { size_px: [1, 1], texels: vec![[1.0; 3]] };
    Map { name: "test".into(), lat_long, cube, rotation_deg: 0.0, repaired_texels: 0 }
}

/// A scene without objects under a rough environment.
fn sky(camera: Camera) -> (Scene, Cube) {
    let cube = Cube::from_fn(16, |d| {
        DVec3::new((7.0 * d.x).sin(), (9.0 * d.y + d.z).cos(), (11.0 * d.z).sin()) + 1.5
    });
    let mut scene = scene_of(Shape::Sphere { radius_m: 0.1 }, 1.5, camera);
    scene.objects.clear();
    scene.environment = Environment::Map(Arc::new(map(cube.clone())));
    (scene, cube)
}

/// Worst difference from the CPU's lookup over six views that see every face.
fn worst_difference(filter: Filter) -> f64 {
    let mut worst = 0.0f64;
    for axis in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
        let camera = Camera {
            eye: DVec3::ZERO,
            target: axis,
            up: DVec3::new(0.3, 0.5, 0.8),
            projection: Projection::Perspective { vertical_fov_deg: 95.0 },
            resolution_px: [64, 64],
        };
        let (scene, cube) = sky(camera);
        let mut request = request(&scene, "undeviated", &[LayerName::Radiance]);
        request.filter = filter;
        let rendering = realtime::render(&GPU, &scene, &request).unwrap();
        let seen = vectors(&rendering.layers, &LayerName::Radiance);
        for (seen, ray) in seen.into_iter().zip(centre_rays(&camera)) {
            let exact = cube.radiance(ray.direction);
            worst = worst.max((seen - exact).abs().max_element());
        }
    }
    worst
}

/// A direction rounded to f32 moves the lookup by 16 texels x 1e-7 of
/// differences up to 3, hence 1e-5 for the worst texel pair.
#[test]
fn the_manual_filter_is_the_cpus_formula() {
    let worst = worst_difference(Filter::Manual);
    assert!(worst < 1e-5, "{worst}");
}

/// A sampler may weigh with eight bits and meet other faces at an edge; a
/// software driver agrees to rounding. More than a texel apart would be wrong.
#[test]
fn the_hardwares_filter_is_close() {
    let worst = worst_difference(Filter::Hardware);
    assert!(worst < 0.5, "{worst}");
}

/// The comparison can fail: the same cube looked up along mirrored directions.
#[test]
fn a_mirrored_environment_is_noticed() {
    let camera = perspective(DVec3::new(1.0, 0.5, 2.0), [32, 32]);
    let (scene, cube) = sky(camera);
    let request = request(&scene, "undeviated", &[LayerName::Radiance]);
    let rendering = realtime::render(&GPU, &scene, &request).unwrap();
    let seen = vectors(&rendering.layers, &LayerName::Radiance);
    let pairs = seen.into_iter().zip(centre_rays(&camera));
    let mirror = DVec3::new(-1.0, 1.0, 1.0);
    let wrong = pairs.map(|(seen, ray)| (seen - cube.radiance(mirror * ray.direction)).length());
    assert!(wrong.fold(0.0, f64::max) > 0.1);
}

/// A constant cube and no cube show the same light.
#[test]
fn a_uniform_environment_needs_no_cube() {
    let camera = perspective(DVec3::new(0.0, 0.0, 4.0), [48, 48]);
    let mut scene = scene_of(Shape::Sphere { radius_m: 1.0 }, 1.5, camera);
    scene.environment = Environment::Uniform(DVec3::new(0.3, 0.7, 1.9));
    let request = request(&scene, "one-interface", &[LayerName::Radiance]);
    let without = realtime::render(&GPU, &scene, &request).unwrap();
    let cube = Cube::from_fn(8, |_| DVec3::new(0.3, 0.7, 1.9));
    scene.environment = Environment::Map(Arc::new(map(cube)));
    let with = realtime::render(&GPU, &scene, &request).unwrap();
    let has_cube = |plan: &scenes::Plan| plan.buffers.iter().any(|b| b.name.contains("_faces"));
    assert!(!has_cube(&without.plan) && has_cube(&with.plan));
    let pairs = without.layers.list[0].data.iter().zip(&with.layers.list[0].data);
    pairs.for_each(|(a, b)| assert!((a - b).abs() <= 1e-6 * a.abs(), "{a} {b}"));
}
