//! The same scene for other renderers: anyone's second opinion.
//!
//! A scene is written as a folder: the other renderer's scene file, meshes and
//! environment beside it. What a format cannot say is an error, never a scene
//! that looks alike and means something else.

mod gltf;
mod mitsuba;
mod pbrt;
mod surface;

use crate::{Scene, Surface};
use std::path::{Path, PathBuf};

/// Formats that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Mitsuba 3 XML.
    Mitsuba,
    /// pbrt-v4.
    Pbrt,
    /// glTF 2.0 with `KHR_materials_ior`, `_transmission`, `_volume` and
    /// `_dispersion`.
    Gltf,
}

/// Why a scene could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The format has no words for part of the scene.
    #[error("{format:?} cannot express {what} of \"{object}\"\n{advice}")]
    Inexpressible {
        /// Target.
        format: Format,
        /// Part of the scene.
        what: String,
        /// Object's name.
        object: String,
        /// What to do instead.
        advice: String,
    },
    /// The folder is there already.
    #[error("{} exists already; name a folder that does not exist yet", .0.display())]
    Exists(PathBuf),
    /// The disk refused.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// File or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The environment could not be encoded.
    #[error("cannot write {}: {source}", path.display())]
    Image {
        /// File.
        path: PathBuf,
        /// What the encoder said.
        source: exr::error::Error,
    },
}

/// Writes a scene as it stands in frame 0 into a new folder and returns the path
/// of its main file. For another frame hand over [`Scene::still`].
///
/// The folder appears whole or not at all.
///
/// # Errors
/// If the format cannot express the scene, or the folder cannot be written.
pub fn write(scene: &Scene, format: Format, folder: &Path) -> Result<PathBuf, ExportError> {
    if folder.exists() {
        return Err(ExportError::Exists(folder.to_owned()));
    }
    refuse_overlaps(scene, format)?;
    refuse_details(scene, format)?;
    let scene = &scene.still(0);
    let partial = folder.with_extension(format!("partial-{}", std::process::id()));
    let written = (|| {
        std::fs::create_dir_all(&partial).map_err(|source| write_error(&partial, source))?;
        let main = match format {
            Format::Mitsuba => mitsuba::write(scene, &partial)?,
            Format::Pbrt => pbrt::write(scene, &partial)?,
            Format::Gltf => gltf::write(scene, &partial)?,
        };
        std::fs::rename(&partial, folder).map_err(|source| write_error(folder, source))?;
        Ok(folder.join(main))
    })();
    if written.is_err() {
        // The partial folder is ours alone; that it may linger is no second error.
        let _ = std::fs::remove_dir_all(&partial);
    }
    written
}

fn write_error(path: &Path, source: std::io::Error) -> ExportError {
    ExportError::Write { path: path.to_owned(), source }
}

fn write_text(path: &Path, text: &str) -> Result<(), ExportError> {
    std::fs::write(path, text).map_err(|source| write_error(path, source))
}

/// None of the formats has priorities for media that overlap.
fn refuse_overlaps(scene: &Scene, format: Format) -> Result<(), ExportError> {
    let mut first = None;
    for object in &scene.objects {
        let Surface::Dielectric { priority, .. } = object.surface else { continue };
        if *first.get_or_insert(priority) != priority {
            return Err(ExportError::Inexpressible {
                format,
                what: format!("the priority {priority}"),
                object: object.name.clone(),
                advice: "the other renderer decides an overlap of solids by the order of hits; \
                         give all objects the same priority or leave the nested one out"
                    .to_owned(),
            });
        }
    }
    Ok(())
}

/// None of the formats has cracks without thickness, and bump maps and bubbles
/// made by a formula would have to be copied into it.
fn refuse_details(scene: &Scene, format: Format) -> Result<(), ExportError> {
    for object in &scene.objects {
        let details = [
            ("bump", object.bump.is_some()),
            ("crack", object.crack.is_some()),
            ("air", object.air.is_some()),
        ];
        if let Some((key, _)) = details.into_iter().find(|(_, is_there)| *is_there) {
            return Err(ExportError::Inexpressible {
                format,
                what: format!("`{key}`"),
                object: object.name.clone(),
                advice: format!("leave `{key}` out of the scene file"),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
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
            let main =
                write(&scene(tetrahedron()), format, &folder.path().join(format!("{format:?}")))
                    .unwrap();
            let text = std::fs::read_to_string(main).unwrap();
            assert!(text.contains(index), "{format:?}: {text}");
        }
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
        for (name, sent, time_s) in
            [("first", moving.clone(), 0.0), ("third", moving.still(3), 0.3)]
        {
            let main = write(&sent, Format::Gltf, &folder.path().join(name)).unwrap();
            let back =
                crate::import::read(&main, Environment::Uniform(DVec3::ONE), [64, 48]).unwrap();
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
        let crate::Dispersion::Gltf { dispersion } = medium.dispersion else {
            panic!("{medium:?}")
        };
        assert!((dispersion - 0.3).abs() < 1e-6);
        let (ray, sent_ray) = (
            back.camera.ray_through([10.0, 20.0].into()),
            sent.camera.ray_through([10.0, 20.0].into()),
        );
        assert!((ray.direction - sent_ray.direction).length() < 1e-6);
    }
}
