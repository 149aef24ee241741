//! A plan says what will happen; the recorder says what did. They are made
//! apart, and must agree for every method on every kind of body.

use crate::*;
use realtime::methods::{Kind, Method};
use realtime::{METHODS, Timing};
use scenes::environment::{LatLong, Map};
use scenes::{Cube, Mesh, Plan, Rendering};

/// A tetrahedron about the origin, counter-clockwise seen from outside.
fn tetrahedron() -> Shape {
    let corner = |x: f64, y: f64, z: f64| 0.6 * DVec3::new(x, y, z);
    Shape::Mesh(Mesh {
        positions: vec![
            corner(1.0, 1.0, 1.0),
            corner(1.0, -1.0, -1.0),
            corner(-1.0, 1.0, -1.0),
            corner(-1.0, -1.0, 1.0),
        ],
        triangles: vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
        normals: None,
    })
}

pub(crate) fn environments() -> [Environment; 2] {
    let cube = Cube::from_fn(4, |direction| direction + 1.0);
    let lat_long = LatLong { size_px: [1, 1], texels: vec![[1.0; 3]] };
    let map = Map { name: "test".into(), lat_long, cube, rotation_deg: 0.0, repaired_texels: 0 };
    [Environment::Uniform(DVec3::ONE), Environment::Map(Arc::new(map))]
}

fn scenes() -> Vec<Scene> {
    let shapes = [
        Shape::Sphere { radius_m: 0.7 },
        Shape::Box { half_extent_m: DVec3::splat(0.5) },
        Shape::Cylinder { radius_m: 0.5, half_height_m: 0.6 },
        tetrahedron(),
    ];
    let cameras = [parallel(2.1, [24, 16]), perspective(DVec3::new(0.4, 0.8, 3.5), [24, 16])];
    let mut scenes = Vec::new();
    for shape in &shapes {
        for camera in cameras {
            for environment in environments() {
                // Analytic shapes have one kind of normal.
                let kinds = if shape.mesh().is_some() { 2 } else { 1 };
                for normals in [Normals::Smooth, Normals::Flat].into_iter().take(kinds) {
                    let mut scene = scene_of(shape.clone(), 1.5, camera);
                    scene.environment = environment.clone();
                    scene.objects[0].normals = normals;
                    scenes.push(scene);
                }
            }
        }
    }
    scenes
}

/// Cracked, bumpy, bubbly ice that deforms, before opaque things that move.
fn everything() -> Scene {
    use scenes::scene::{Air, Bump, Crack, Light, Motion, Paint, Wave};
    let camera = perspective(DVec3::new(0.4, 0.8, 3.5), [24, 16]);
    let mut scene = scene_of(tetrahedron(), 1.31, camera);
    scene.environment = environments()[1].clone();
    scene.media[1].absorption_per_m = DVec3::new(0.5, 0.1, 0.0);
    let ice = &mut scene.objects[0];
    ice.bump = Some(Bump { amplitude: 0.1, frequency_per_m: 5.0, seed: 1 });
    ice.crack = Some(Crack { count: 2, grid: 8, seed: 2 });
    ice.air = Some(Air { planes: 3, bubbles: 0, bubble_radius: 0.01, seed: 3 });
    ice.deform = Some(Wave {
        amplitude_m: 0.02,
        wavelength_m: 1.0,
        travel: DVec3::X,
        direction: DVec3::Y,
        period_s: 1.0,
    });
    let white = || Paint::Constant(DVec3::ONE);
    let checker = Paint::Checker { colours: [DVec3::ZERO, DVec3::ONE], size_m: 0.3 };
    let mut ball = body(Shape::Sphere { radius_m: 0.3 });
    ball.surface = Surface::Unlit { radiance: white() };
    ball.world_from_object = DAffine3::from_translation(DVec3::new(-1.0, 0.3, -1.0));
    ball.motion = Some(Motion::Spin { axis: DVec3::Y, deg_per_s: 10.0 });
    let mut floor = body(Shape::Box { half_extent_m: DVec3::new(2.0, 0.1, 2.0) });
    floor.surface = Surface::Lambert { albedo: checker };
    floor.world_from_object = DAffine3::from_translation(DVec3::new(0.0, -1.0, 0.0));
    scene.objects.extend([ball, floor]);
    let (direction, irradiance) = (DVec3::NEG_Y, DVec3::ONE);
    scene.lights = vec![Light::Directional { direction, irradiance }];
    scene
}

/// Each feature of [`everything`] taken away in turn.
fn with_less() -> Vec<Scene> {
    let changes: [fn(&mut Scene); 6] = [
        |scene| scene.objects[0].bump = None,
        |scene| scene.objects[0].crack = None,
        |scene| scene.objects[0].air = None,
        |scene| scene.objects[0].deform = None,
        |scene| scene.objects.truncate(1),
        |scene| scene.objects[1].motion = None,
    ];
    let less = |change: fn(&mut Scene)| {
        let mut scene = everything();
        change(&mut scene);
        scene
    };
    changes.into_iter().map(less).collect()
}

fn many_layers() -> Vec<LayerName> {
    let buffer = |name: &str| LayerName::Buffer(name.into());
    vec![
        LayerName::Radiance,
        LayerName::Coverage,
        LayerName::Exit,
        LayerName::Flags,
        buffer("thickness"),
        buffer("back_normal"),
    ]
}

/// Names of what was executed: all but the entry for the whole frame's time.
fn executed(rendering: &Rendering) -> Vec<&str> {
    let names = rendering.passes.iter().map(|pass| pass.name.as_str());
    names.filter(|name| !name.ends_with(": frame")).collect()
}

/// The number of layers is known only once they are counted; until then their
/// bytes are stated for one.
pub(crate) fn kept(plan: &Plan, rendering: &Rendering) -> bool {
    let counted = plan.buffers.iter().any(|buffer| buffer.name.ends_with("(per layer)"));
    let bytes = rendering.counters["bytes"];
    plan.passes == rendering.plan.passes
        && plan.passes == executed(rendering)
        && rendering.plan.bytes() == bytes
        && (counted || plan.bytes() == bytes)
}

#[test]
fn every_method_executes_its_plan() {
    let timing =
        Timing { warm_up: 0, seconds: 0.0, min_frames: 1, max_frames: 1, positions_per_axis: 1 };
    // The projection changes no pass and no byte: one of the two is enough.
    // Every third: both environments and both kinds of normals occur.
    let plain = scenes().into_iter().filter(|scene| scene.camera.eye.x != 0.0).step_by(3);
    let cases = plain.map(|scene| (scene, METHODS.iter().collect::<Vec<_>>()));
    let inner = |id: &str| Method::find(id).unwrap();
    let rich = with_less().into_iter().chain([everything()]);
    let rich = rich.map(|scene| (scene, ["blended", "two-interface", "multi"].map(inner).to_vec()));
    for (scene, methods) in cases.chain(rich) {
        let scene = &scene;
        for method in methods {
            for positions_per_axis in [1, 2] {
                let mut request = request(scene, method.id, &many_layers());
                request.view.positions_per_axis = positions_per_axis;
                request.timing = Some(timing);
                let plan = realtime::plan(scene, &request).unwrap();
                let rendering = realtime::render(&GPU, scene, &request).unwrap();
                let (ran, bytes) = (executed(&rendering), rendering.counters["bytes"]);
                assert!(
                    kept(&plan, &rendering),
                    "{}: {:?} ran {ran:?}, {} bytes allocated {bytes}",
                    method.id,
                    plan.passes,
                    plan.bytes()
                );
            }
        }
    }
}

/// Cracks in the back normals: one pass more, and the light bends at them.
#[test]
fn cracks_may_bend_light() {
    let mut scene = everything();
    scene.camera.resolution_px = [64, 64];
    let asked = |words: &[(&str, &str)]| with(request(&scene, "blended", &many_layers()), words);
    let [without, with_cracks] = [asked(&[]), asked(&[("crack_normals", "back")])];
    let [a, b] = [&without, &with_cracks].map(|request| {
        let rendering = realtime::render(&GPU, &scene, request).unwrap();
        assert!(kept(&realtime::plan(&scene, request).unwrap(), &rendering));
        rendering
    });
    assert_eq!(a.passes.len() + 1, b.passes.len());
    let exits = |r: &Rendering| vectors(&r.layers, &LayerName::Exit);
    let bent = exits(&a).iter().zip(exits(&b)).filter(|(a, b)| angle(**a, *b) > 1e-3).count();
    let body = exits(&a).iter().filter(|exit| **exit != DVec3::ZERO).count();
    assert!(bent > body / 20 && bent < body, "{bent} of {body}");
}

/// The comparison can fail: a plan with a pass or a byte too few is not kept.
#[test]
fn a_pass_or_a_byte_too_many_is_noticed() {
    let scene = scene_of(Shape::Sphere { radius_m: 0.7 }, 1.5, parallel(2.1, [16, 16]));
    let request = request(&scene, "blended", &[LayerName::Radiance]);
    let rendering = realtime::render(&GPU, &scene, &request).unwrap();
    let plan = realtime::plan(&scene, &request).unwrap();
    assert!(kept(&plan, &rendering));
    let mut fewer = plan.clone();
    fewer.passes.retain(|pass| pass != "back");
    assert!(!kept(&fewer, &rendering));
    let mut smaller = plan;
    smaller.buffers[0].bytes -= 1;
    assert!(!kept(&smaller, &rendering));
}

/// What a feature needs is there with it and gone without it.
#[test]
fn a_feature_that_is_taken_away_takes_its_passes_and_buffers_with_it() {
    let names = |scene: &Scene| {
        let mut request = request(scene, "blended", &[LayerName::Radiance]);
        request.timing = Some(Timing {
            warm_up: 0,
            seconds: 0.0,
            min_frames: 1,
            max_frames: 1,
            positions_per_axis: 1,
        });
        let plan = realtime::plan(scene, &request).unwrap();
        let buffers = plan.buffers.iter().map(|buffer| buffer.name.clone());
        plan.passes.into_iter().chain(buffers).collect::<Vec<_>>()
    };
    let all = names(&everything());
    let needs: [&[&str]; 6] = [
        &["bumps"],
        &["cracks"],
        &["air"],
        &[],
        &["background", "cube +X", "surroundings", "drawn cube"],
        &[],
    ];
    for (scene, needed) in with_less().iter().zip(needs) {
        let left = names(scene);
        for name in needed {
            assert!(all.iter().any(|n| n == name), "{name} should be there: {all:?}");
            assert!(left.iter().all(|n| n != name), "{name} should be gone: {left:?}");
        }
    }
    // What does not move is drawn into the cube once, before the timed frames.
    let mut still = everything();
    still.objects[0].deform = None;
    still.objects[1].motion = None;
    let left = names(&still);
    assert!(left.iter().any(|n| n == "cube +X") && left.iter().all(|n| n != "timed: cube +X"));
    assert!(all.iter().any(|n| n == "timed: cube +X"));
}

/// Every word of every parameter, for every kind of scene, compiles.
#[test]
fn every_combination_of_pieces_compiles() {
    let mut combinations = 0;
    for mut scene in scenes().into_iter().chain([everything()]) {
        scene.media[1].absorption_per_m = DVec3::ONE;
        for method in METHODS.iter() {
            for parameters in settings(method) {
                for filter in [Filter::Manual, Filter::Hardware] {
                    for layers in [many_layers(), vec![LayerName::Exit], vec![LayerName::Radiance]]
                    {
                        let mut request = request(&scene, method.id, &layers);
                        request.filter = filter;
                        request.parameters = parameters.clone();
                        realtime::plan(&scene, &request).unwrap();
                        combinations += 1;
                    }
                }
            }
        }
    }
    assert!(combinations > 1000, "{combinations}");
}

/// The defaults, then each other word and both ends of each number in turn.
fn settings(method: &Method) -> Vec<std::collections::BTreeMap<String, String>> {
    let mut all = vec![[].into()];
    for parameter in method.parameters {
        let values = match parameter.kind {
            Kind::Number { min, max, .. } => vec![min.to_string(), max.to_string()],
            Kind::Choice(words) => words.iter().skip(1).map(|w| (*w).to_owned()).collect(),
        };
        all.extend(values.into_iter().map(|value| [(parameter.name.to_owned(), value)].into()));
    }
    all
}

/// What is timed is what a game would draw, whatever the judged image is.
#[test]
fn the_timed_frame_has_one_position_and_the_hardwares_filter() {
    let mut scene = scene_of(Shape::Sphere { radius_m: 0.7 }, 1.5, parallel(2.1, [16, 16]));
    scene.environment = environments()[1].clone();
    let mut request = request(&scene, "one-interface", &many_layers());
    request.view.positions_per_axis = 4;
    request.timing = Some(Timing {
        warm_up: 0,
        seconds: 0.0,
        min_frames: 1,
        max_frames: 1,
        positions_per_axis: 1,
    });
    let plan = realtime::plan(&scene, &request).unwrap();
    let bytes = |name: &str| plan.buffers.iter().find(|b| b.name == name).map(|b| b.bytes);
    assert_eq!(bytes("radiance"), Some(16 * 16 * 16));
    assert_eq!(bytes("timed: radiance"), Some(16 * 16 * 16));
    assert!(bytes("environment_faces").is_some() && bytes("timed: environment_cube").is_some());
    assert_eq!(bytes("timed: environment_faces"), None);
    assert!(plan.passes.iter().any(|p| p == "centre: back"));
    assert!(!plan.passes.iter().any(|p| p == "timed: back"));
    let shaded = |plan: &Plan, name: &str| plan.passes.iter().filter(|p| *p == name).count();
    assert_eq!([shaded(&plan, "shade"), shaded(&plan, "timed: shade")], [16, 1]);
    // Unless more are asked for: one frame after the other.
    request.timing = request.timing.map(|timing| Timing { positions_per_axis: 2, ..timing });
    let plan = realtime::plan(&scene, &request).unwrap();
    assert_eq!([shaded(&plan, "shade"), shaded(&plan, "timed: shade")], [16, 4]);
    assert!(kept(&plan, &realtime::render(&GPU, &scene, &request).unwrap()));
}
