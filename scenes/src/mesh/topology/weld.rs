//! One vertex per distinct position, and triangles without area or twin removed.

use crate::{Mesh, mesh::CornerNormals};
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// Bits of a position, with one zero instead of two.
fn key(position: DVec3) -> [u64; 3] {
    position.to_array().map(|x| if x == 0.0 { 0 } else { x.to_bits() })
}

/// Merges vertices at exactly equal positions, in order of first use, so that
/// edges that meet share their indices. Unused positions disappear.
#[must_use]
pub fn weld(mesh: &Mesh) -> Mesh {
    let mut index_of = HashMap::with_capacity(mesh.positions.len());
    let mut positions = Vec::with_capacity(mesh.positions.len());
    let triangles = mesh
        .triangles
        .iter()
        .map(|triangle| {
            triangle.map(|old| {
                let position = mesh.positions[old as usize];
                *index_of.entry(key(position)).or_insert_with(|| {
                    positions.push(position);
                    u32::try_from(positions.len() - 1).unwrap_or(u32::MAX)
                })
            })
        })
        .collect();
    Mesh { positions, triangles, normals: mesh.normals.clone() }
}

/// What [`clean`] removed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Removed {
    /// Triangles without area: two corners at one place, or three on a line.
    pub degenerate: usize,
    /// Triangles of the same three vertices in the same sense as an earlier one.
    pub duplicate: usize,
}

/// True where a triangle has no area in f64.
pub(super) fn is_degenerate(mesh: &Mesh, triangle: usize) -> bool {
    mesh.area_vector(triangle) == DVec3::ZERO
}

/// Same three vertices in the same sense give the same key.
pub(super) fn cyclic([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Removes triangles whose corners are not three different vertices, and
/// repeated triangles. A sliver whose three vertices differ stays, even without
/// area: without it its neighbours' edges would be open.
#[must_use]
pub fn clean(mesh: &Mesh) -> (Mesh, Removed) {
    let (kept, removed) = kept(mesh);
    let normals = mesh.normals.as_ref().map(|normals| CornerNormals {
        values: normals.values.clone(),
        indices: kept.iter().map(|index| normals.indices[*index]).collect(),
    });
    let triangles = kept.iter().map(|index| mesh.triangles[*index]).collect();
    (Mesh { positions: mesh.positions.clone(), triangles, normals }, removed)
}

/// Which triangles [`clean`] keeps.
pub(crate) fn kept(mesh: &Mesh) -> (Vec<usize>, Removed) {
    let mut removed = Removed::default();
    let mut seen = HashSet::with_capacity(mesh.triangles.len());
    let kept = (0..mesh.triangles.len())
        .filter(|index| {
            let [a, b, c] = mesh.triangles[*index];
            let degenerate = a == b || b == c || c == a;
            let duplicate = !degenerate && !seen.insert(cyclic([a, b, c]));
            removed.degenerate += usize::from(degenerate);
            removed.duplicate += usize::from(duplicate);
            !degenerate && !duplicate
        })
        .collect();
    (kept, removed)
}
