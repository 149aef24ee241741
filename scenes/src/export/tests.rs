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
            .unwrap()
            .file;
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
        let main = write(&sent, Format::Gltf, &folder.path().join(name)).unwrap().file;
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
    let main = write(&sent, Format::Gltf, &folder.path().join("out")).unwrap().file;
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

/// What is round is written as triangles, and how far they are from it is told.
#[test]
fn balls_and_cylinders_are_tessellated_to_a_stated_error() {
    let folder = tempfile::tempdir().unwrap();
    let shapes =
        [Shape::Sphere { radius_m: 2.0 }, Shape::Cylinder { radius_m: 2.0, half_height_m: 0.5 }];
    for (index, shape) in shapes.into_iter().enumerate() {
        let [low, high] = shape.bounds();
        let sent = scene(shape);
        let written = write(&sent, Format::Gltf, &folder.path().join(index.to_string())).unwrap();
        let back = crate::import::load(&written.file, crate::format::default_sky).unwrap();
        let mesh = back.objects[0].shape.mesh().unwrap();
        assert_eq!(crate::topology::solid(mesh), Ok(()));
        let [l, h] = mesh.bounds();
        assert!(l.distance(low) < 1e-6 && h.distance(high) < 1e-6, "{l} {h}");
        // The stated error holds at every triangle's middle.
        let (_, told) = written.notes[0].split_once("up to ").unwrap();
        let within: f64 = told.split(' ').next().unwrap().parse().unwrap();
        assert!(within < 1e-4 && within > 1e-6, "{told}");
        let deepest = (0..mesh.triangles.len())
            .map(|i| {
                let [a, b, c] = mesh.corners(i);
                let middle = (a + b + c) / 3.0;
                let radius = if index == 0 { middle.length() } else { middle.x.hypot(middle.z) };
                let is_round = index == 0 || (a.y - b.y).abs() + (b.y - c.y).abs() > 0.5;
                if is_round { 1.0 - radius / 2.0 } else { 0.0 }
            })
            .fold(0.0, f64::max);
        assert!(deepest <= 1.05 * within && deepest > 0.4 * within, "{deepest} {within}");
        // Corners have the normals of the shape.
        let normals = mesh.normals.as_ref().unwrap();
        for (t, n) in mesh.triangles.iter().zip(&normals.indices) {
            for (p, n) in t.iter().zip(n) {
                let (p, n) = (mesh.positions[*p as usize], normals.values[*n as usize]);
                let round = if index == 0 { p } else { DVec3::new(p.x, 0.0, p.z) };
                let off = n.distance(round.normalize_or_zero());
                assert!(off < 1e-6 || n.y.abs() > 1.0 - 1e-6, "{p} {n}");
            }
        }
    }
}

/// The round trip states its own error, and the statement is true.
#[test]
fn the_round_trip_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut sent = scene(tetrahedron());
    sent.media[1].eta = Eta::try_from(1.52).unwrap();
    sent.media[1].absorption_per_m = DVec3::new(400.0, 1.0, 2.0);
    let written = write(&sent, Format::Gltf, &folder.path().join("plain")).unwrap();
    let told = written.notes.last().unwrap();
    assert!(told.starts_with("read back, positions differ by up to 0.0e0 m"), "{told}");
    let back = crate::import::load(&written.file, crate::format::default_sky).unwrap();
    let off = (back.media[1].eta.get() - 1.52).abs();
    assert!(off > 0.0 && told.contains(&format!("indices (R, G, B) by {off:.1e}")), "{told}");
    let off = (back.media[1].absorption_per_m - sent.media[1].absorption_per_m).abs();
    assert!(off.max_element() < 1e-4, "{off}");
    // Three resonances are more than the format's one law can say.
    sent.media[1].dispersion = crate::Dispersion::Sellmeier {
        b: [1.039_612_12, 0.231_792_344, 1.010_469_45],
        c_um2: [0.006_000_698_67, 0.020_017_914_4, 103.560_653],
    };
    let written = write(&sent, Format::Gltf, &folder.path().join("bk7")).unwrap();
    let back = crate::import::load(&written.file, crate::format::default_sky).unwrap();
    let off = crate::medium::RGB_WAVELENGTH_UM
        .map(|um| (back.media[1].eta_at(um) - sent.media[1].eta_at(um)).abs());
    let off = off.into_iter().fold(0.0, f64::max);
    let told = written.notes.last().unwrap();
    assert!(off > 1e-5 && told.contains(&format!("indices (R, G, B) by {off:.1e}")), "{told}");
}

#[test]
fn dispersion_is_written_for_pbrt_and_refused_for_mitsuba() {
    let folder = tempfile::tempdir().unwrap();
    let mut sent = scene(Shape::Sphere { radius_m: 1.0 });
    let plain = write(&sent, Format::Pbrt, &folder.path().join("plain")).unwrap();
    assert!(std::fs::read_to_string(plain.file).unwrap().contains("\"float eta\" 1.5"));
    sent.media[1].dispersion = crate::Dispersion::Cauchy { a: 1.5, b_um2: 0.0042 };
    let written = write(&sent, Format::Pbrt, &folder.path().join("pbrt")).unwrap();
    let text = std::fs::read_to_string(&written.file).unwrap();
    let (_, list) = text.split_once("\"spectrum eta\" [ ").unwrap();
    let list: Vec<f64> =
        list.split(" ]").next().unwrap().split(' ').map(|word| word.parse().unwrap()).collect();
    assert_eq!((list.len(), list[0], list[188]), (190, 360.0, 830.0));
    for pair in list.as_chunks::<2>().0 {
        assert!((pair[1] - (1.5 + 0.0042 / (pair[0] * 1e-3).powi(2))).abs() < 1e-12);
    }
    assert!(written.notes[0].contains("off by up to"), "{:?}", written.notes);
    let error = write(&sent, Format::Mitsuba, &folder.path().join("m")).unwrap_err().to_string();
    assert!(error.contains("the dispersion") && error.contains("--to pbrt"), "{error}");
}

/// Nothing of the surroundings is lost silently.
#[test]
fn surroundings_that_a_format_cannot_say_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut wet = scene(tetrahedron());
    wet.media[0].eta = Eta::try_from(1.33).unwrap();
    for format in [Format::Pbrt, Format::Gltf] {
        let error = write(&wet, format, &folder.path().join("x")).unwrap_err().to_string();
        assert!(error.contains("the index 1.33 of \"surroundings\""), "{error}");
        assert!(error.contains("--to mitsuba"), "{error}");
    }
    assert!(write(&wet, Format::Mitsuba, &folder.path().join("wet")).is_ok());
    wet.media[0].absorption_per_m = DVec3::ONE;
    assert!(write(&wet, Format::Mitsuba, &folder.path().join("y")).is_err());
}

/// Opaque surfaces and lights go out and in again.
#[test]
fn gltf_has_opaque_surfaces_and_lights() {
    use crate::scene::{Light, Paint};
    let folder = tempfile::tempdir().unwrap();
    let mut sent = scene(tetrahedron());
    let with = |surface: Surface| Object { surface, ..sent.objects[0].clone() };
    let lambert = Surface::Lambert { albedo: Paint::Constant(DVec3::new(0.5, 0.25, 0.125)) };
    let lamp = Surface::Unlit { radiance: Paint::Constant(DVec3::new(8.0, 4.0, 0.0)) };
    let more = [with(lambert.clone()), with(lamp.clone())];
    sent.objects.extend(more);
    let position_m = DVec3::new(1.0, 2.0, 3.0);
    sent.lights = vec![
        Light::Point { position_m, intensity: DVec3::new(8.0, 2.0, 4.0) },
        Light::Directional { direction: DVec3::NEG_Y, irradiance: DVec3::new(0.5, 1.0, 0.0) },
    ];
    for format in [Format::Pbrt, Format::Mitsuba] {
        let error = write(&sent, format, &folder.path().join("x")).unwrap_err().to_string();
        assert!(error.contains("--to gltf"), "{error}");
    }
    let written = write(&sent, Format::Gltf, &folder.path().join("out")).unwrap();
    let back = crate::import::load(&written.file, crate::format::default_sky).unwrap();
    assert_eq!([&back.objects[1].surface, &back.objects[2].surface], [&lambert, &lamp]);
    assert_eq!(back.lights[0], sent.lights[0]);
    let Light::Directional { direction, irradiance } = back.lights[1] else { panic!() };
    assert!(direction.distance(DVec3::NEG_Y) < 1e-7 && irradiance == DVec3::new(0.5, 1.0, 0.0));
    let checker = Paint::Checker { colours: [DVec3::ZERO, DVec3::ONE], size_m: 1.0 };
    sent.objects[1].surface = Surface::Lambert { albedo: checker };
    let error = write(&sent, Format::Gltf, &folder.path().join("y")).unwrap_err().to_string();
    assert!(error.contains("checkered") && error.contains("one colour"), "{error}");
}
