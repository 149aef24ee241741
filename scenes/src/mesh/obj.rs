//! Wavefront OBJ files.

use crate::topology::{clean, weld};
use crate::{Mesh, mesh::CornerNormals};
use glam::DVec3;
use std::io::Write;
use std::path::{Path, PathBuf};

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

/// Reads all triangles and polygons of a file (polygons as fans) into one mesh.
///
/// Vertices at equal positions become one. Normals (`vn`) are kept if every face
/// has them, at unit length. Faces with fewer than three different vertices are
/// left out. Materials, groups and texture coordinates are not read.
///
/// # Errors
/// If the file cannot be read, has no faces, or has a number that is not finite
/// or an index that does not exist; with the line.
pub fn read(path: &Path) -> Result<Mesh, ObjError> {
    let bytes =
        std::fs::read(path).map_err(|source| ObjError::Io { path: path.to_owned(), source })?;
    parse(&bytes).map_err(|Bad { line, what }| ObjError::Syntax {
        path: path.to_owned(),
        line,
        what,
    })
}

struct Bad {
    line: Option<usize>,
    what: String,
}

fn parse(bytes: &[u8]) -> Result<Mesh, Bad> {
    check_lines(bytes)?;
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let no_materials = |_: &Path| Ok((Vec::new(), Default::default()));
    let mut reader = bytes;
    let (models, _) = tobj::load_obj_buf(&mut reader, &options, no_materials)
        .map_err(|error| Bad { line: None, what: format!("not an OBJ file: {error}") })?;
    let mut mesh = Mesh::default();
    for model in &models {
        mesh.append(&from_tobj(&model.mesh));
    }
    if mesh.triangles.is_empty() {
        let what = "no faces; write at least one line like \"f 1 2 3\"".to_owned();
        return Err(Bad { line: None, what });
    }
    Ok(clean(&weld(&mesh)).0)
}

fn from_tobj(part: &tobj::Mesh) -> Mesh {
    let vectors = |numbers: &[f64]| -> Vec<DVec3> {
        numbers.as_chunks().0.iter().copied().map(DVec3::from_array).collect()
    };
    let triangles = part.indices.as_chunks().0.to_vec();
    let is_complete = !triangles.is_empty() && part.normal_indices.len() == part.indices.len();
    let normals = is_complete.then(|| CornerNormals {
        values: vectors(&part.normals).iter().map(|n| n.normalize_or(DVec3::Y)).collect(),
        indices: part.normal_indices.as_chunks().0.to_vec(),
    });
    Mesh { positions: vectors(&part.positions), triangles, normals }
}

/// Finds what the reader would accept or report without a line: numbers that
/// are not finite, and indices that do not exist.
fn check_lines(bytes: &[u8]) -> Result<(), Bad> {
    let mut counts = Counts::default();
    for (index, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let text = String::from_utf8_lossy(line);
        counts.check(&text).map_err(|what| Bad { line: Some(index + 1), what })?;
    }
    Ok(())
}

/// Definitions so far.
#[derive(Default)]
struct Counts {
    positions: i64,
    textures: i64,
    normals: i64,
}

impl Counts {
    fn check(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                self.positions += 1;
                numbers(words, "v x y z")
            }
            Some("vn") => {
                self.normals += 1;
                numbers(words, "vn x y z")
            }
            Some("vt") => {
                self.textures += 1;
                Ok(())
            }
            Some("f") => words.try_for_each(|corner| self.check_corner(corner)),
            _ => Ok(()),
        }
    }

    fn check_corner(&self, corner: &str) -> Result<(), String> {
        let counts = [
            (self.positions, "vertices (v)"),
            (self.textures, "texture coordinates (vt)"),
            (self.normals, "normals (vn)"),
        ];
        for (index, (count, kind)) in corner.split('/').zip(counts) {
            if index.is_empty() {
                continue;
            }
            let number: i64 = index.parse().map_err(|_| {
                format!("\"{corner}\" is not a corner; write v, v/vt, v//vn or v/vt/vn")
            })?;
            if number == 0 || number > count || number < -count {
                return Err(format!(
                    "index {number} in \"{corner}\" does not exist: {count} {kind} are defined \
                     so far; count from 1 (or from -1 backwards)"
                ));
            }
        }
        Ok(())
    }
}

fn numbers<'a>(words: impl Iterator<Item = &'a str>, form: &str) -> Result<(), String> {
    let mut count = 0;
    for word in words.take(3) {
        count += 1;
        let value: f64 =
            word.parse().map_err(|_| format!("\"{word}\" is not a number; write {form}"))?;
        if !value.is_finite() {
            return Err(format!("{word} is not a finite number; write {form}"));
        }
    }
    if count == 3 {
        Ok(())
    } else {
        Err(format!("{count} numbers where 3 are needed; write {form}"))
    }
}

/// Writes a mesh with its normals, if it has any. Numbers are written so that
/// [`read`] gives the same bits.
///
/// # Errors
/// As the writer reports.
pub fn write(mesh: &Mesh, mut to: impl Write) -> std::io::Result<()> {
    for p in &mesh.positions {
        writeln!(to, "v {} {} {}", p.x, p.y, p.z)?;
    }
    let Some(normals) = &mesh.normals else {
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| i + 1);
            writeln!(to, "f {a} {b} {c}")?;
        }
        return Ok(());
    };
    for n in &normals.values {
        writeln!(to, "vn {} {} {}", n.x, n.y, n.z)?;
    }
    for (triangle, corner) in mesh.triangles.iter().zip(&normals.indices) {
        let [a, b, c] = triangle.map(|i| i + 1);
        let [p, q, r] = corner.map(|i| i + 1);
        writeln!(to, "f {a}//{p} {b}//{q} {c}//{r}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
