//! glTF out and in again is the same scene, up to the 32 bits in which the
//! format stores positions, normals, matrices and indices.
#![allow(clippy::unwrap_used, reason = "a scene that cannot be read must fail its test")]

use glam::DVec3;
use reference::{Level, Request, render};
use scenes::export::{Format, write};
use scenes::{LayerName, Layers, Scene, View};

/// Scenes that glTF can say: meshes, no overlaps, nothing opaque.
const SCENES: [&str; 7] = ["ice-cube", "cup", "teapot", "mug", "diamond", "prism", "uniform-cup"];

/// Every event adds the rounding of its own normal, and later ones magnify it:
/// what is said here is said of chains of at most so many.
const MOST_EVENTS: f64 = 4.0;

fn layers(scene: &Scene) -> Layers {
    let layers = vec![LayerName::Exit, LayerName::Events];
    let view = View { resolution_px: [64, 64], positions_per_axis: 1, frame: 0, layers };
    render(scene, &Request::new(view, Level::R0)).unwrap().layers
}

fn exits(scene: &Scene) -> Vec<DVec3> {
    let layers = layers(scene);
    layers.get(&LayerName::Exit).unwrap().data.chunks(3).map(DVec3::from_slice).collect()
}

fn through_gltf(scene: &Scene) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = write(scene, Format::Gltf, &folder.path().join("out")).unwrap().file;
    scenes::find(path.to_str().unwrap()).unwrap()
}

/// Largest change of each exit when the camera moves by 1e-6 m to either side
/// along each of its axes, or turns by as many radians, which is
/// 16 times the rounding of a direction to 32 bits.
fn sensitivity(scene: &Scene, at_rest: &[DVec3]) -> Vec<f64> {
    let basis = scene.camera.basis();
    let mut largest = vec![0.0_f64; at_rest.len()];
    let steps = [basis.right, -basis.right, basis.up, -basis.up].map(|axis| 1e-6 * axis);
    let turn = (scene.camera.target - scene.camera.eye).length();
    for [eye, target] in steps.iter().flat_map(|step| [[*step; 2], [DVec3::ZERO, turn * *step]]) {
        let mut moved = scene.clone();
        moved.camera.eye += eye;
        moved.camera.target += target;
        for ((most, here), there) in largest.iter_mut().zip(at_rest).zip(exits(&moved)) {
            *most = most.max(here.distance(there));
        }
    }
    largest
}

/// Shares of pixels that are well-conditioned, and of those the ones whose exit
/// differs by more than 1e-5.
fn shares(sent: &Scene, back: &Scene) -> [f64; 2] {
    let (a, b) = (exits(sent), exits(back));
    let sensitivity = sensitivity(sent, &a);
    let (mut conditioned, mut wrong) = (0.0, 0.0);
    let layers = layers(sent);
    let events = &layers.get(&LayerName::Events).unwrap().data;
    let pairs = a.iter().zip(&b).zip(&sensitivity).zip(events);
    for (((a, b), sensitivity), events) in pairs {
        if *sensitivity < 1e-5 && *events <= MOST_EVENTS {
            conditioned += 1.0;
            wrong += f64::from(u8::from(a.distance(*b) >= 1e-5));
        }
    }
    [conditioned / a.len() as f64, wrong / conditioned]
}

/// Rounding to 32 bits moves a vertex by up to 6e-8 of its distance from the
/// origin. Where moving or turning the camera by a little more changes an exit by less than 1e-5,
/// so does the rounding. Elsewhere, at edges and where curved glass magnifies,
/// nothing can be said of any renderer.
#[test]
fn exit_directions_survive_the_way_out_and_back() {
    for name in SCENES {
        let sent = scenes::builtin(name).unwrap();
        let [conditioned, wrong] = shares(&sent, &through_gltf(&sent));
        assert!(conditioned > 0.5, "{name}: {conditioned}");
        assert!(wrong == 0.0, "{name}: {wrong} of the pixels differ");
    }
}

/// An index that is wrong in the fifth digit is seen.
#[test]
fn a_slightly_wrong_index_is_noticed() {
    let sent = scenes::builtin("diamond").unwrap();
    let mut back = through_gltf(&sent);
    for medium in &mut back.media[1..] {
        medium.eta = scenes::Eta::try_from(medium.eta.get() + 5e-5).unwrap();
    }
    let [_, wrong] = shares(&sent, &back);
    assert!(wrong > 0.05, "{wrong}");
}

/// Positions and normals of every corner of every triangle, in order.
fn corners(scene: &Scene) -> Vec<DVec3> {
    let mut list = Vec::new();
    for object in &scene.objects {
        let mesh = object.shape.mesh().unwrap();
        list.extend(mesh.triangles.iter().flatten().map(|i| mesh.positions[*i as usize]));
        if let Some(normals) = &mesh.normals {
            list.extend(normals.indices.iter().flatten().map(|i| normals.values[*i as usize]));
        }
        let place = object.world_from_object;
        list.extend([place.translation, place.matrix3 * DVec3::X, place.matrix3 * DVec3::Y]);
    }
    list
}

/// What is 32 bits wide already passes through unchanged.
#[test]
fn a_second_trip_changes_no_position() {
    for name in SCENES {
        let sent = scenes::builtin(name).unwrap();
        let once = through_gltf(&sent);
        let (once, twice) = (corners(&once), corners(&through_gltf(&once)));
        assert_eq!(once.len(), twice.len(), "{name}");
        let far = |(a, b): (&DVec3, &DVec3)| a.distance(*b) > 1e-7;
        assert_eq!(once.iter().zip(&twice).position(far), None, "{name}");
    }
}
