//! Rectangular patches of vertices.

use crate::Mesh;
use glam::DVec3;

/// A vertex number that fits the mesh's index type.
pub(super) fn index(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Adds a patch of `columns` x `rows` quads, two triangles each. `at(column,
/// row)` gives the vertex; seen from the side of its normals, columns run to
/// the right and rows upwards.
pub(super) fn add_patch(
    mesh: &mut Mesh,
    columns: u32,
    rows: u32,
    mut at: impl FnMut(u32, u32) -> DVec3,
) {
    let first = index(mesh.positions.len());
    for row in 0..=rows {
        mesh.positions.extend((0..=columns).map(|column| at(column, row)));
    }
    let vertex = |column: u32, row: u32| first + row * (columns + 1) + column;
    for row in 0..rows {
        for column in 0..columns {
            let [a, b] = [vertex(column, row), vertex(column + 1, row)];
            let [d, c] = [vertex(column, row + 1), vertex(column + 1, row + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}
