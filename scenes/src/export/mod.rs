//! The same scene for other renderers: anyone's second opinion.
//!
//! A scene is written as a folder: the other renderer's scene file, meshes and
//! environment beside it. What a format cannot say is an error, never a scene
//! that looks alike and means something else.

mod gltf;
mod mitsuba;
mod pbrt;
mod round_trip;
mod surface;

use crate::{Object, Scene, Surface};
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

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Mitsuba => "Mitsuba",
            Self::Pbrt => "pbrt",
            Self::Gltf => "glTF",
        })
    }
}

/// Why a scene could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The format has no words for part of the scene.
    #[error("{format} cannot express {what} of \"{object}\"\n{advice}")]
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

/// What was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The main file.
    pub file: PathBuf,
    /// What the form could only say nearly, and how near, a sentence each.
    pub notes: Vec<String>,
}

/// Writes a scene as it stands in frame 0 into a new folder. For another frame hand over [`Scene::still`].
///
/// The folder appears whole or not at all.
///
/// # Errors
/// If the format cannot express the scene, or the folder cannot be written.
pub fn write(scene: &Scene, format: Format, folder: &Path) -> Result<Written, ExportError> {
    if folder.exists() {
        return Err(ExportError::Exists(folder.to_owned()));
    }
    refuse_overlaps(scene, format)?;
    refuse_details(scene, format)?;
    refuse_surroundings(scene, format)?;
    let scene = &scene.still(0);
    let mut main = "";
    let mut notes: Vec<String> = Vec::new();
    let renaming = |source| write_error(folder, source);
    crate::whole::replace(folder, renaming, |partial| {
        std::fs::create_dir_all(partial).map_err(|source| write_error(partial, source))?;
        main = match format {
            Format::Mitsuba => mitsuba::write(scene, partial, &mut notes)?,
            Format::Pbrt => pbrt::write(scene, partial, &mut notes)?,
            Format::Gltf => gltf::write(scene, partial, &mut notes)?,
        };
        if format == Format::Gltf {
            notes.extend(round_trip::told(scene, &partial.join(main)));
        }
        Ok(())
    })?;
    Ok(Written { file: folder.join(main), notes })
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

/// What fills the space outside all bodies: an index can be said to Mitsuba alone,
/// absorption and dispersion to none.
fn refuse_surroundings(scene: &Scene, format: Format) -> Result<(), ExportError> {
    let outside = &scene.media[0];
    let refused = |what: String, advice: &str| {
        let (object, advice) = ("surroundings".to_owned(), advice.to_owned());
        Err(ExportError::Inexpressible { format, what, object, advice })
    };
    if outside.absorbs() || outside.is_dispersive() {
        let which = if outside.absorbs() { "absorption" } else { "dispersion" };
        return refused(format!("the {which}"), "no format can: write a medium without it");
    }
    if outside.eta.get() != 1.0 && format != Format::Mitsuba {
        let what = format!("the index {}", outside.eta.get());
        return refused(what, "Mitsuba can (--to mitsuba), or remove [surroundings] medium");
    }
    Ok(())
}

/// The error for a surface that only glTF can say.
fn opaque(format: Format, object: &Object) -> ExportError {
    ExportError::Inexpressible {
        format,
        what: "the opaque surface".to_owned(),
        object: object.name.clone(),
        advice: "glTF can (--to gltf); only transparent bodies and the environment are written \
                 for other renderers"
            .to_owned(),
    }
}

#[cfg(test)]
mod tests;
