//! Wavefront OBJ files.

mod lines;
mod model;
mod statements;
mod write;

use std::path::{Path, PathBuf};

pub use model::Model;
pub use write::write;

/// Why a file is not a mesh.
#[derive(Debug, thiserror::Error)]
pub enum ObjError {
    /// The operating system refused.
    #[error("{}: {source}; check the path", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// A line that the format does not allow.
    #[error("{}{}: {what}", path.display(), line.map_or_else(String::new, |l| format!(":{l}")))]
    Syntax {
        /// The file.
        path: PathBuf,
        /// Line number from 1, where it is known.
        line: Option<usize>,
        /// What is wrong and what to write instead.
        what: String,
    },
}

/// Reads all faces of a file into one mesh.
///
/// Polygons are cut into triangles, concave ones without overlaps, the same way
/// whatever corner their list begins with. Vertices at equal positions become
/// one, and so do those along open edges that differ in their last bits only.
/// Faces with fewer than three different vertices are left out, as are repeated
/// ones. Normals (`vn`) are those of each corner; where there are none, or such
/// as are zero or not numbers, they are made from the faces. Materials, groups,
/// texture coordinates, lines and points are not read.
///
/// # Errors
/// If the file cannot be read, has no faces, or has a position that is not finite
/// or an index that does not exist; with the line.
pub fn read(path: &Path) -> Result<Model, ObjError> {
    let bytes =
        std::fs::read(path).map_err(|source| ObjError::Io { path: path.to_owned(), source })?;
    model::parse(&bytes).map_err(|Bad { line, what }| ObjError::Syntax {
        path: path.to_owned(),
        line,
        what,
    })
}

struct Bad {
    line: Option<usize>,
    what: String,
}

#[cfg(test)]
mod tests;
