//! What is written, and what is refused.

#![allow(clippy::unwrap_used, reason = "a failing test may panic")]
use super::*;
use crate::scene::{Crack, Motion, Normals, Wave};
use crate::{Camera, Environment, Eta, Medium, MediumId, Mesh, Object, Projection, Shape};
use glam::{DAffine3, DVec3};

fn tetrahedron() -> Shape {
    Shape::Mesh(Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        normals: None,
    })
}

fn scene(shape: Shape) -> Scene {
    let object = Object {
        world_from_object: DAffine3::from_translation(DVec3::new(0.0, 0.0, 2.0)),
        normals: Normals::Flat,
        ..Object::solid("body", shape, MediumId(1))
    };
    let glass = Medium::plain("glass", Eta::try_from(1.5).unwrap());
    let camera = Camera {
        eye: DVec3::new(0.0, 0.0, 4.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection: Projection::Perspective { vertical_fov_deg: 40.0 },
        resolution_px: [64, 48],
    };
    Scene::in_white_light("test", camera, vec![Medium::vacuum(), glass], vec![object])
}

#[test]
fn every_format_writes_the_index_and_the_mesh() {
    let folder = tempfile::tempdir().unwrap();
    for (format, index) in [
        (Format::Mitsuba, "<float name=\"int_ior\" value=\"1.5\"/>"),
        (Format::Pbrt, "\"float eta\" 1.5"),
        (Format::Gltf, "\"ior\": 1.5"),
    ] {
        let main = write(&scene(tetrahedron()), format, &folder.path().join(format!("{format:?}")))
            .unwrap();
        let text = std::fs::read_to_string(main).unwrap();
        assert!(text.contains(index), "{format:?}: {text}");
    }
}

/// A box is twelve flat triangles in every format.
#[test]
fn a_box_is_written_as_triangles() {
    let folder = tempfile::tempdir().unwrap();
    let half_extent_m = DVec3::new(1.0, 2.0, 0.5);
    let sent = scene(Shape::Box { half_extent_m });
    for format in [Format::Mitsuba, Format::Pbrt, Format::Gltf] {
        write(&sent, format, &folder.path().join(format!("{format:?}"))).unwrap();
    }
    let main = folder.path().join("Gltf/scene.gltf");
    let back = crate::import::read(&main, Environment::Uniform(DVec3::ONE), [64, 48]).unwrap();
    let mesh = back.objects[0].shape.mesh().unwrap();
    assert_eq!((mesh.triangles.len(), mesh.bounds()), (12, [-half_extent_m, half_extent_m]));
    let xml = std::fs::read_to_string(folder.path().join("Mitsuba/scene.xml")).unwrap();
    assert!(xml.contains("<boolean name=\"face_normals\" value=\"true\"/>"), "{xml}");
}

#[test]
fn what_a_format_cannot_say_is_refused_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let slab = scene(Shape::Slab { thickness_m: 0.1 });
    for format in [Format::Mitsuba, Format::Pbrt, Format::Gltf] {
        let error = write(&slab, format, &folder.path().join("out")).unwrap_err();
        assert!(
            error.to_string().contains("cannot express the unbounded slab of \"body\""),
            "{error}"
        );
    }
    let mut nested = scene(tetrahedron());
    nested.objects.push(nested.objects[0].clone());
    nested.objects[1].surface = Surface::Dielectric { medium: MediumId(1), priority: 1 };
    assert!(write(&nested, Format::Mitsuba, &folder.path().join("out")).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// What moves and deforms is written where it is in the frame.
#[test]
fn a_moving_body_is_written_as_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    let mut moving = scene(tetrahedron());
    moving.sequence.seconds_per_frame = 0.1;
    let object = &mut moving.objects[0];
    object.motion = Some(Motion::Spin { axis: DVec3::Y, deg_per_s: 300.0 });
    object.deform = Some(Wave {
        amplitude_m: 0.1,
        wavelength_m: 0.7,
        travel: DVec3::X,
        direction: DVec3::Y,
        period_s: 1.0,
    });
    for (name, sent, time_s) in [("first", moving.clone(), 0.0), ("third", moving.still(3), 0.3)] {
        let main = write(&sent, Format::Gltf, &folder.path().join(name)).unwrap();
        let back = crate::import::read(&main, Environment::Uniform(DVec3::ONE), [64, 48]).unwrap();
        let (back, object) = (&back.objects[0], &moving.objects[0]);
        let placed = object.world_from_object_at(time_s);
        assert!(back.world_from_object.abs_diff_eq(placed, 1e-12), "{name}");
        let (found, wanted) = (back.shape.mesh().unwrap(), object.shape_at(time_s));
        for (a, b) in found.positions.iter().zip(&wanted.mesh().unwrap().positions) {
            assert!((*a - *b).length() < 1e-7, "{name}: {a} for {b}");
        }
    }
    let mut cracked = scene(tetrahedron());
    cracked.objects[0].crack = Some(Crack { count: 1, grid: 8, seed: 0 });
    let error = write(&cracked, Format::Gltf, &folder.path().join("x")).unwrap_err();
    assert!(error.to_string().contains("leave `crack` out"), "{error}");
}

/// What glTF can say survives the way out and back.
#[test]
fn gltf_written_is_gltf_read() {
    let folder = tempfile::tempdir().unwrap();
    let mut sent = scene(tetrahedron());
    sent.media[1].absorption_per_m = DVec3::new(0.5, 1.0, 2.0);
    sent.media[1].dispersion = crate::Dispersion::Gltf { dispersion: 0.3 };
    let main = write(&sent, Format::Gltf, &folder.path().join("out")).unwrap();
    let back = crate::import::read(&main, Environment::Uniform(DVec3::ONE), [64, 48]).unwrap();
    assert_eq!(back.objects[0].shape, sent.objects[0].shape);
    assert_eq!(back.objects[0].world_from_object, sent.objects[0].world_from_object);
    let medium = back.medium_of(&back.objects[0]).unwrap();
    assert!((medium.eta.get() - 1.5).abs() < 1e-6);
    assert!((medium.absorption_per_m - sent.media[1].absorption_per_m).length() < 1e-6);
    let crate::Dispersion::Gltf { dispersion } = medium.dispersion else { panic!("{medium:?}") };
    assert!((dispersion - 0.3).abs() < 1e-6);
    let (ray, sent_ray) = (
        back.camera.ray_through([10.0, 20.0].into()),
        sent.camera.ray_through([10.0, 20.0].into()),
    );
    assert!((ray.direction - sent_ray.direction).length() < 1e-6);
}
