//! Shading normals for meshes that bring none.

use crate::topology::edges::{Sets, edges, sides};
use crate::{Mesh, mesh::CornerNormals};
use glam::DVec3;
use std::collections::HashMap;

/// Unit normals of the triangles; zero where a triangle has no area.
#[must_use]
pub fn of_faces(mesh: &Mesh) -> Vec<DVec3> {
    (0..mesh.triangles.len()).map(|i| mesh.area_vector(i).normalize_or_zero()).collect()
}

/// Every corner gets its triangle's normal.
#[must_use]
pub fn flat(mesh: &Mesh) -> CornerNormals {
    let values = of_faces(mesh);
    let indices =
        (0..mesh.triangles.len()).map(|i| [u32::try_from(i).unwrap_or(u32::MAX); 3]).collect();
    CornerNormals { values, indices }
}

/// One normal per vertex: the mean of its triangles' normals, each weighted by
/// the angle of the triangle at the vertex.
///
/// The weight makes the result independent of how a flat part is triangulated.
/// Where the mean vanishes the normal is that of one of the triangles.
///
/// Source: Thürmer & Wüthrich, "Computing vertex normals from polygonal
/// facets", Journal of Graphics Tools 3 (1), 1998.
#[must_use]
pub fn smooth(mesh: &Mesh) -> CornerNormals {
    smooth_over(mesh, &of_faces(mesh))
}

/// As [`smooth`], with the normals of faces that the triangles are parts of: one
/// unit vector per triangle, or zero. The angle of a face at a corner is then the
/// sum of its triangles', and its normal is weighed over its whole area.
#[must_use]
pub(crate) fn smooth_over(mesh: &Mesh, faces: &[DVec3]) -> CornerNormals {
    let mut values = vec![DVec3::ZERO; mesh.positions.len()];
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let angles = corner_angles(mesh.corners(index));
        for (vertex, angle) in triangle.iter().zip(angles) {
            values[*vertex as usize] += faces[index] * angle;
        }
    }
    let fallback = any_face(mesh, faces);
    for (value, fallback) in values.iter_mut().zip(fallback) {
        *value = value.try_normalize().unwrap_or(fallback);
    }
    CornerNormals { values, indices: mesh.triangles.clone() }
}

/// As [`smooth`], but the mean does not reach across edges where the two
/// triangles' normals differ by more than `crease_deg` degrees.
#[must_use]
pub fn creased(mesh: &Mesh, crease_deg: f64) -> CornerNormals {
    let faces = of_faces(mesh);
    let mut groups = smoothing_groups(mesh, &faces, crease_deg.to_radians().cos());
    let mut sums: HashMap<u32, DVec3> = HashMap::new();
    for (index, face) in faces.iter().enumerate() {
        let angles = corner_angles(mesh.corners(index));
        for (corner, angle) in angles.into_iter().enumerate() {
            let group = groups.root(corner_id(index, corner));
            *sums.entry(group).or_default() += *face * angle;
        }
    }
    let mut values = Vec::with_capacity(sums.len());
    let mut index_of = HashMap::with_capacity(sums.len());
    let indices = (0..mesh.triangles.len())
        .map(|index| {
            [0, 1, 2].map(|corner| {
                let group = groups.root(corner_id(index, corner));
                *index_of.entry(group).or_insert_with(|| {
                    let face = faces[index].try_normalize().unwrap_or(DVec3::Y);
                    values.push(sums[&group].try_normalize().unwrap_or(face));
                    u32::try_from(values.len() - 1).unwrap_or(u32::MAX)
                })
            })
        })
        .collect();
    CornerNormals { values, indices }
}

/// Sets of corners that share a normal.
fn smoothing_groups(mesh: &Mesh, faces: &[DVec3], crease_cos: f64) -> Sets {
    let mut groups = Sets::new(3 * mesh.triangles.len());
    let sides = sides(mesh);
    for edge in edges(&sides) {
        let [one, two] = edge else { continue };
        let is_smooth = faces[one.triangle()].dot(faces[two.triangle()]) >= crease_cos;
        if !is_smooth || one.is_forward(mesh) == two.is_forward(mesh) {
            continue;
        }
        for vertex in [one.low, one.high] {
            let corner = |triangle: usize| {
                let at = mesh.triangles[triangle].iter().position(|v| *v == vertex);
                corner_id(triangle, at.unwrap_or(0))
            };
            groups.join(corner(one.triangle()), corner(two.triangle()));
        }
    }
    groups
}

fn corner_id(triangle: usize, corner: usize) -> u32 {
    u32::try_from(3 * triangle + corner).unwrap_or(u32::MAX)
}

/// Angles of a triangle at its corners, radians; zero at a side without length.
fn corner_angles(corners: [DVec3; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| {
        let to_next = corners[(i + 1) % 3] - corners[i];
        let to_last = corners[(i + 2) % 3] - corners[i];
        to_next.cross(to_last).length().atan2(to_next.dot(to_last))
    })
}

/// For each vertex, the normal of one of its triangles.
fn any_face(mesh: &Mesh, faces: &[DVec3]) -> Vec<DVec3> {
    let mut found = vec![DVec3::Y; mesh.positions.len()];
    for (triangle, face) in mesh.triangles.iter().zip(faces) {
        if *face != DVec3::ZERO {
            triangle.iter().for_each(|vertex| found[*vertex as usize] = *face);
        }
    }
    found
}
