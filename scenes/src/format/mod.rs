//! The scene format: TOML in, a checked [`Scene`] out.
//!
//! Every error names file, line and column, says what is wrong and what to
//! write instead. Unknown keys are errors. A key that is valid and that some
//! renderer cannot show yet is that renderer's business.
//!
//! Every key there is, in one scene:
//!
//! ```toml
#![doc = include_str!("complete.toml")]
//! ```

mod body;
mod choice;
mod document;
mod error;
mod number;
mod overrides;
mod resolve;
mod set;
mod sky;
#[cfg(test)]
mod tests;

pub(crate) use body::default_sky;
pub use error::{Error, MeshError, Place, Problem};
pub use overrides::Overrides;

use crate::Scene;
use document::Document;
use error::At;
use std::path::Path;

/// Reads a scene file.
///
/// # Errors
/// If the file, or anything it refers to, cannot be read or makes no sense.
pub fn load(path: &Path) -> Result<Scene, Error> {
    let text = std::fs::read_to_string(path)
        .map_err(|source| Error::Read { path: path.to_owned(), source })?;
    let base = path.parent().unwrap_or(Path::new(""));
    let mut scene = parse(&text, &path.display().to_string(), base)?;
    scene.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    scene.source.path = Some(path.to_owned());
    if scene.title.is_empty() {
        scene.title.clone_from(&scene.name);
    }
    Ok(scene)
}

/// Reads a scene from text. `name` stands for it in messages and becomes the
/// scene's name; paths in the text are relative to `base`.
///
/// # Errors
/// If the text, or anything it refers to, cannot be read or makes no sense.
pub fn parse(text: &str, name: &str, base: &Path) -> Result<Scene, Error> {
    let document: Result<Document, At> = toml::from_str(text).map_err(At::from);
    let scene = document.and_then(|document| resolve::resolve(&document, text, base));
    let mut scene = scene.map_err(|at| at.within(name, text))?;
    scene.name = name.to_owned();
    Ok(scene)
}
