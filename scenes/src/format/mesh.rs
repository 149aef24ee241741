//! Where meshes come from: files and generators.

use crate::Mesh;
use glam::DVec3;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Why a mesh could not be read.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file is missing, broken, or not a mesh.
    #[error("{}: {reason}", path.display())]
    File {
        /// The mesh file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
}

/// Built-in meshes.
pub(super) const NAMES: &[&str] = &[];

/// Makes the built-in mesh of that name.
pub(super) fn generate(_name: &str) -> Option<Mesh> {
    None
}

/// Reads a Wavefront OBJ file.
pub(super) fn read_obj(path: &Path) -> Result<Mesh, MeshError> {
    let wrap = |reason: String| MeshError::File { path: path.to_owned(), reason };
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    let (models, _) = tobj::load_obj(path, &options).map_err(|error| wrap(error.to_string()))?;
    let mut mesh = Mesh::default();
    let mut known: HashMap<[u64; 3], u32> = HashMap::new();
    for model in &models {
        let points = model.mesh.positions.chunks_exact(3);
        let numbers: Vec<u32> = points
            .map(|p| {
                let point = DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]));
                *known.entry((point + 0.0).to_array().map(f64::to_bits)).or_insert_with(|| {
                    mesh.positions.push(point);
                    (mesh.positions.len() - 1) as u32
                })
            })
            .collect();
        for triangle in model.mesh.indices.chunks_exact(3) {
            let index = |i: u32| numbers.get(i as usize).copied();
            match (index(triangle[0]), index(triangle[1]), index(triangle[2])) {
                (Some(a), Some(b), Some(c)) => mesh.triangles.push([a, b, c]),
                _ => return Err(wrap("a face names a vertex that is not there".to_owned())),
            }
        }
    }
    Ok(mesh)
}
