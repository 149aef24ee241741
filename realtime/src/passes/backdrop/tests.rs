//! The drawn cube shows what is where: an environment that tells its direction,
//! and a ball whose outline has a closed form.
#![allow(clippy::unwrap_used, reason = "a test that cannot render must fail")]

use crate::composition::inputs::Inputs;
use crate::drawn::frame_uniforms::Viewed;
use crate::drawn::geometry::Geometry;
use crate::frame::{Composition, Frame};
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::readback;
use crate::gpu::recorder::Recorder;
use crate::methods::{Method, Settings};
use crate::request::{Filter, Keep, Request};
use crate::wgsl::Choices;
use glam::{DAffine3, DVec2, DVec3};
use scenes::environment::{LatLong, Map};
use scenes::scene::{Motion, Paint};
use scenes::{Cube, Environment, LayerName, Scene, Shape, Surface, View};
use std::sync::Arc;

const SIZE_PX: u32 = 48;
const BALL_RADIUS_M: f64 = 0.8;

/// A glass ball in an environment whose radiance is its direction, and a black
/// ball that circles it.
fn scene() -> Scene {
    let mut scene = scenes::builtin("ball").unwrap();
    let cube = Cube::from_fn(SIZE_PX, |direction| 0.5 * direction + 0.5);
    let lat_long = LatLong { size_px: [1, 1], texels: vec![[1.0; 3]] };
    let name = "direction".to_owned();
    let map = Map { name, lat_long, cube, rotation_deg: 0.0, repaired_texels: 0 };
    scene.environment = Environment::Map(Arc::new(map));
    scene.sequence.frames = 2;
    scene.sequence.seconds_per_frame = 1.0;
    let mut black = scene.objects[0].clone();
    black.shape = Arc::new(Shape::Sphere { radius_m: BALL_RADIUS_M });
    black.surface = Surface::Unlit { radiance: Paint::Constant(DVec3::ZERO) };
    black.world_from_object = DAffine3::from_translation(DVec3::new(2.0, 0.9, -1.2));
    let points_m = vec![DVec3::ZERO, DVec3::new(-1.0, 0.4, 3.0)];
    black.motion = Some(Motion::Path { points_m, seconds_per_point: 1.0 });
    scene.objects.push(black);
    scene
}

/// Direction of the middle of a texel, as WebGPU lays out the faces of a cube.
fn direction(face: usize, x: u32, y: u32) -> DVec3 {
    let at = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(SIZE_PX) - 1.0;
    let (a, b) = (at(x), at(y));
    let d = [
        DVec3::new(1.0, -b, -a),
        DVec3::new(-1.0, -b, a),
        DVec3::new(a, 1.0, b),
        DVec3::new(a, -1.0, -b),
        DVec3::new(a, -b, 1.0),
        DVec3::new(-a, -b, -1.0),
    ];
    d[face].normalize()
}

/// Each texel's direction and what was drawn there.
fn drawn(scene: &Scene, frame: u32) -> Vec<(DVec3, DVec3)> {
    let gpu = Gpu::open(None).unwrap();
    let layers = vec![LayerName::Radiance];
    let view = View { resolution_px: [32; 2], positions_per_axis: 1, frame, layers };
    let method = Method::find("one-interface").unwrap();
    let request =
        Request { filter: Filter::Hardware, ..Request::new(view, method.id, Keep::Needed) };
    let settings = Settings::new(method, &request.parameters).unwrap();
    let geometry = Geometry::new(scene, frame).unwrap();
    let camera = &scene.camera;
    let inputs = Inputs {
        method,
        settings: &settings,
        scene,
        camera,
        geometry: &geometry,
        request: &request,
        outputs: &["radiance"],
        resolution_px: [32; 2],
        choices: Choices::default(),
        index_matched: false,
    };
    let composition = Composition::new(inputs).unwrap();
    let allocator = Allocator::new(&gpu);
    let viewed = Viewed {
        geometry: &geometry,
        environment: &scene.environment,
        camera,
        eta_outside: 1.0,
        resolution_px: [32; 2],
        shift: DVec2::ZERO,
    };
    let frame = Frame::new(&gpu, &allocator, &composition, &viewed, &[DVec2::ZERO]).unwrap();
    let mut recorder = Recorder::new(&gpu, false);
    frame.record(&mut recorder, true);
    recorder.finish().unwrap();
    texels(&gpu, frame.outputs.image("environment_cube").unwrap())
}

fn texels(gpu: &Gpu, cube: &wgpu::Texture) -> Vec<(DVec3, DVec3)> {
    let values = readback::texture_values(gpu, cube, 4).unwrap();
    assert_eq!(values.len(), (6 * SIZE_PX * SIZE_PX * 4) as usize);
    let texel = |i: usize| {
        let i = i as u32;
        let (face, rest) = (i / (SIZE_PX * SIZE_PX), i % (SIZE_PX * SIZE_PX));
        direction(face as usize, rest % SIZE_PX, rest / SIZE_PX)
    };
    let texels = values.chunks_exact(4).enumerate();
    texels.map(|(i, v)| (texel(i), DVec3::new(v[0].into(), v[1].into(), v[2].into()))).collect()
}

/// How far inside the black ball's outline a direction lies, radians.
fn inside(scene: &Scene, time_s: f64, direction: DVec3) -> f64 {
    let at = scene.objects[1].world_from_object_at(time_s).translation;
    (BALL_RADIUS_M / at.length()).asin() - direction.angle_between(at)
}

/// Share of texels that show what stands in their direction. Texels at the
/// outline itself are left out.
fn right(texels: &[(DVec3, DVec3)], scene: &Scene, time_s: f64) -> f64 {
    let clear = texels.iter().filter(|(d, _)| inside(scene, time_s, *d).abs() > 1e-4);
    let (mut good, mut all) = (0, 0);
    for (direction, light) in clear {
        let expected = if inside(scene, time_s, *direction) > 0.0 {
            DVec3::ZERO
        } else {
            0.5 * *direction + 0.5
        };
        good += usize::from((*light - expected).abs().max_element() < 1e-3);
        all += 1;
    }
    good as f64 / f64::from(all)
}

#[test]
fn every_texel_shows_what_stands_in_its_direction() {
    let scene = scene();
    let texels = drawn(&scene, 0);
    assert_eq!(right(&texels, &scene, 0.0), 1.0);
    // The controls: a mirrored and a turned cube are seen to be wrong.
    let mirrored: Vec<_> =
        texels.iter().map(|(d, light)| (DVec3::new(-d.x, d.y, d.z), *light)).collect();
    assert!(right(&mirrored, &scene, 0.0) < 0.5);
    let turned: Vec<_> =
        texels.iter().map(|(d, light)| (DVec3::new(d.z, d.y, -d.x), *light)).collect();
    assert!(right(&turned, &scene, 0.0) < 0.5);
}

#[test]
fn the_cube_changes_only_where_something_moved() {
    let mut scene = scene();
    let (before, after) = (drawn(&scene, 0), drawn(&scene, 1));
    assert_eq!(right(&after, &scene, 1.0), 1.0);
    let mut changed = 0;
    for ((direction, old), (_, new)) in before.iter().zip(&after) {
        let covered = [0.0, 1.0].iter().any(|t| inside(&scene, *t, *direction) > -1e-4);
        assert!(covered || old == new, "{direction}");
        changed += usize::from(old != new);
    }
    assert!(changed > 100, "{changed}");
    scene.objects[1].motion = None;
    assert_eq!(drawn(&scene, 0), drawn(&scene, 1));
}
