//! Meshes as text.

use crate::Mesh;
use std::io::Write;

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
