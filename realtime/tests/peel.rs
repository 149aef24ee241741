//! Four ways of depth peeling find the same layers.
#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use glam::{DAffine3, DVec3};
use realtime::{Gpu, Keep, Request, Timing, plan, render};
use scenes::layer::flag;
use scenes::{
    Camera, LayerName, MediumId, Object, Projection, Rendering, Scene, Shape, Surface, View,
};
use std::sync::LazyLock;

static GPU: LazyLock<Gpu> = LazyLock::new(|| Gpu::open(None).unwrap());
const WAYS: [&str; 4] = ["slots", "everitt", "dual", "cascade"];

fn scene(shapes: &[Shape], centre: DVec3) -> Scene {
    let object = |shape: &Shape| Object {
        world_from_object: DAffine3::from_translation(centre),
        ..Object::solid("body", shape.clone(), MediumId(1))
    };
    let camera = Camera {
        eye: DVec3::new(0.7, 1.9, 4.1),
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection: Projection::Perspective { vertical_fov_deg: 38.0 },
        resolution_px: [256, 256],
    };
    test_support::scene(shapes.iter().map(object).collect(), 1.5, camera)
}

fn mesh(name: &str) -> Shape {
    Shape::Mesh(scenes::generate::builtin(name).unwrap())
}

fn request(scene: &Scene, parameters: &[(&str, &str)], layers: Vec<LayerName>) -> Request {
    let resolution_px = scene.camera.resolution_px;
    let view = View { resolution_px, positions_per_axis: 1, frame: 0, layers };
    let parameters = test_support::parameters(parameters);
    Request { parameters, ..Request::new(view, "multi", Keep::Needed) }
}

fn buffer(name: String) -> LayerName {
    LayerName::Buffer(name)
}

/// Count, depths, normals and facings of eight layers: all there is to see.
fn all(layers: u32) -> Vec<LayerName> {
    let mut names = vec![LayerName::Flags, buffer("layer_count".into())];
    for layer in 0..layers {
        for kind in ["depth", "normal", "facing"] {
            names.push(buffer(format!("layer_{kind}.{layer}")));
        }
    }
    names
}

fn found(scene: &Scene, parameters: &[(&str, &str)], layers: u32) -> Rendering {
    render(&GPU, scene, &request(scene, parameters, all(layers))).unwrap()
}

fn data(rendering: &Rendering, name: &str) -> Vec<f64> {
    rendering.layers.get(&buffer(name.into())).unwrap().data.clone()
}

/// Bits of everything that starts with a name, in order.
fn bits(rendering: &Rendering, start: &str) -> Vec<u64> {
    let layers = rendering.layers.list.iter();
    let wanted = layers.filter(|layer| layer.name.to_string().starts_with(start));
    wanted.flat_map(|layer| layer.data.iter().map(|value| value.to_bits())).collect()
}

fn flagged(rendering: &Rendering) -> Vec<bool> {
    let flags = &rendering.layers.get(&LayerName::Flags).unwrap().data;
    flags.iter().map(|flags| *flags as u32 & flag::OVERFLOW != 0).collect()
}

/// Depths bitwise; normals bitwise, packed as they are. Dual peeling, whose
/// normals pass through blending, keeps all of their bits too.
#[test]
fn four_ways_find_the_same_layers() {
    for name in ["teapot", "shell", "torus", "nested-shells"] {
        let scene = scene(&[mesh(name)], DVec3::ZERO);
        let slots = found(&scene, &[("peel", "slots")], 8);
        let most = data(&slots, "layer_count").into_iter().fold(0.0, f64::max);
        assert!((4.0..=16.0).contains(&most), "{name}: {most}");
        assert_eq!(slots.counters["layer_bytes"], 256 * 256 * 8 * most as u64);
        for way in &WAYS[1..] {
            let other = found(&scene, &[("peel", way)], 8);
            for part in ["layer_count", "layer_depth", "layer_normal", "layer_facing", "flags"] {
                let (a, b) = (bits(&slots, part), bits(&other, part));
                assert!(!a.is_empty());
                let wrong = a.iter().zip(&b).filter(|(a, b)| a != b).count();
                assert_eq!(wrong, 0, "{name}: {way} differs from slots in {part}");
            }
        }
    }
}

/// Also of analytic bodies, in a view without perspective, and of several solids.
#[test]
fn analytic_bodies_have_the_same_layers() {
    let ball = |radius_m| Shape::Sphere { radius_m };
    let half_extent_m = DVec3::new(0.4, 0.9, 0.3);
    let mut scene = scene(&[ball(1.0), ball(0.6), Shape::Box { half_extent_m }], DVec3::ZERO);
    scene.camera.projection = Projection::Orthographic { height_m: 2.3 };
    for (priority, object) in scene.objects.iter_mut().enumerate() {
        let medium = MediumId(u16::from(priority != 1));
        object.surface = Surface::Dielectric { medium, priority: priority as i32 };
    }
    let slots = found(&scene, &[], 6);
    assert_eq!(data(&slots, "layer_count").into_iter().fold(0.0, f64::max), 6.0);
    for way in &WAYS[1..] {
        let other = found(&scene, &[("peel", way)], 6);
        assert!(bits(&slots, "layer") == bits(&other, "layer"), "{way}");
    }
}

#[test]
fn layers_are_sorted_and_the_same_in_every_run() {
    let scene = scene(&[mesh("teapot")], DVec3::ZERO);
    for way in WAYS {
        let first = found(&scene, &[("peel", way)], 4);
        for _ in 0..4 {
            let again = found(&scene, &[("peel", way)], 4);
            assert!(bits(&first, "") == bits(&again, ""), "{way}");
        }
        let depths = [0, 1, 2, 3].map(|n| data(&first, &format!("layer_depth.{n}")));
        for (pixel, count) in data(&first, "layer_count").into_iter().enumerate() {
            for n in 0..4 {
                assert_eq!(depths[n][pixel] > 0.0, (n as f64) < count, "{way}");
                assert!(n == 0 || n as f64 >= count || depths[n - 1][pixel] <= depths[n][pixel]);
            }
        }
    }
}

/// The comparison can fail.
#[test]
fn half_a_pixel_gives_other_bits() {
    let still = found(&scene(&[mesh("shell")], DVec3::ZERO), &[], 4);
    // A pixel at this distance is 2 tan(19 deg) 4.6 m / 256 = 12 mm.
    let moved = found(&scene(&[mesh("shell")], DVec3::new(0.006, 0.0, 0.0)), &[], 4);
    for part in ["layer_count", "layer_depth", "layer_normal"] {
        assert!(bits(&still, part) != bits(&moved, part), "{part}");
    }
}

/// Two boxes at the same place: slots and the cascade keep both walls, passes
/// behind each other see one.
#[test]
fn coincident_walls_are_kept_or_lost_as_documented() {
    let cube = || mesh("cube");
    let scene = scene(&[cube(), cube()], DVec3::ZERO);
    let once = self::scene(&[cube()], DVec3::ZERO);
    let single = data(&found(&once, &[], 2), "layer_count");
    assert!(single.iter().filter(|count| **count == 2.0).count() > 10_000);
    for (way, times) in [("slots", 2.0), ("everitt", 1.0), ("dual", 1.0), ("cascade", 2.0)] {
        let both = found(&scene, &[("peel", way)], 4);
        let counts = data(&both, "layer_count");
        let wrong = counts.iter().zip(&single).filter(|(a, b)| **a != times * **b).count();
        assert_eq!(wrong, 0, "{way}");
        assert!(!flagged(&both).contains(&true), "{way}");
        let first = data(&both, "layer_depth.0");
        assert_eq!(first, data(&found(&once, &[("peel", way)], 2), "layer_depth.0"), "{way}");
    }
}

/// More layers than room: flagged where the chain looked, the nearest kept by
/// peeling and by the cascade, both ends by dual peeling.
#[test]
fn too_many_layers_are_cut_as_documented_and_flagged() {
    let scene = scene(&[mesh("nested-shells")], DVec3::ZERO);
    let whole = found(&scene, &[], 16);
    assert!(!flagged(&whole).contains(&true));
    let counts = data(&whole, "layer_count");
    let depths: Vec<_> = (0..16).map(|n| data(&whole, &format!("layer_depth.{n}"))).collect();
    for room in [4, 5] {
        for way in WAYS {
            let text = room.to_string();
            let cut = found(&scene, &[("peel", way), ("max_layers", &text)], room);
            assert_eq!(cut.counters["layers"], u64::from(room));
            let (held, flags) = (data(&cut, "layer_count"), flagged(&cut));
            let kept: Vec<_> = (0..room).map(|n| data(&cut, &format!("layer_depth.{n}"))).collect();
            for (pixel, count) in counts.iter().enumerate() {
                let (count, room) = (*count as usize, room as usize);
                assert_eq!(held[pixel] as usize, count.min(room), "{way} {room}");
                assert!(flags[pixel] || count <= room, "{way} {room}: not flagged");
                for (n, layer) in kept.iter().enumerate().take(count.min(room)) {
                    let far = way == "dual" && n >= room.div_ceil(2) && count > room;
                    let expected = if far { count - room + n } else { n };
                    if way != "slots" || count <= room {
                        assert_eq!(layer[pixel], depths[expected][pixel], "{way} {room} {n}");
                    }
                }
            }
        }
    }
}

/// Passes and bytes are those of the plan, for every way, with and without
/// enough room.
#[test]
fn every_way_executes_its_plan() {
    let mesh_and_ball = [mesh("torus"), Shape::Sphere { radius_m: 0.5 }];
    let mut scene = scene(&mesh_and_ball, DVec3::ZERO);
    scene.camera.resolution_px = [32, 24];
    for way in WAYS {
        for max_layers in ["3", "32"] {
            let parameters = [("peel", way), ("max_layers", max_layers)];
            let mut request =
                request(&scene, &parameters, vec![LayerName::Radiance, LayerName::Flags]);
            request.timing = Some(Timing {
                warm_up: 0,
                seconds: 0.0,
                min_frames: 1,
                max_frames: 1,
                positions_per_axis: 1,
            });
            let rendering = render(&GPU, &scene, &request).unwrap();
            let names = rendering.passes.iter().map(|pass| pass.name.as_str());
            let ran: Vec<_> = names.filter(|name| !name.ends_with(": frame")).collect();
            assert_eq!(rendering.plan.passes, ran, "{way}");
            assert_eq!(rendering.plan.bytes(), rendering.counters["bytes"], "{way}");
            // Before layers are counted, what repeats is stated once.
            let mut once = ran.clone();
            let mut seen = Vec::new();
            once.retain(|name| {
                let new = !seen.contains(name);
                seen.push(name);
                new
            });
            let planned = plan(&scene, &request).unwrap().passes;
            let stated: Vec<_> =
                planned.iter().map(|name| name.trim_end_matches(" (per layer)")).collect();
            assert_eq!(stated, once, "{way}");
        }
    }
}
