//! Interpolated shading normals in world space.

use glam::{DMat3, DVec3};
use scenes::Mesh;

/// Unit normals and which three belong to each triangle.
#[derive(Clone, Debug)]
pub(crate) struct Smooth {
    values: Vec<DVec3>,
    indices: Vec<[u32; 3]>,
}

impl Smooth {
    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        (self.values.capacity() * size_of::<DVec3>() + self.indices.capacity() * 12) as u64
    }

    /// The unit normal at a point of a triangle; zero where the three cancel.
    pub(crate) fn at(&self, triangle: usize, weights: [f64; 3]) -> DVec3 {
        let [a, b, c] = self.indices[triangle].map(|i| self.values[i as usize]);
        (a * weights[0] + b * weights[1] + c * weights[2]).normalize_or_zero()
    }
}

/// The mesh's own normals, or means of the adjacent faces weighted by their
/// angles where it brings none.
/// Source: G. Thürmer, C. Wüthrich, "Computing Vertex Normals from Polygonal
/// Facets", Journal of Graphics Tools 3(1), 1998.
pub(crate) fn smooth_normals(mesh: &Mesh, normal_from_object: DMat3) -> Smooth {
    // A mirrored mesh is baked with its last two corners swapped.
    let mirrored = normal_from_object.determinant() < 0.0;
    let order = |[a, b, c]: &[u32; 3]| if mirrored { [*a, *c, *b] } else { [*a, *b, *c] };
    let world = |n: DVec3| (normal_from_object * n).normalize_or_zero();
    if let Some(normals) = &mesh.normals {
        let values = normals.values.iter().map(|n| world(*n)).collect();
        return Smooth { values, indices: normals.indices.iter().map(order).collect() };
    }
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for (index, triangle) in mesh.triangles.iter().enumerate() {
        let corners = mesh.corners(index);
        let face = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        for i in 0..3 {
            let (to, other) =
                (corners[(i + 1) % 3] - corners[i], corners[(i + 2) % 3] - corners[i]);
            let angle = to.cross(other).length().atan2(to.dot(other));
            sums[triangle[i] as usize] += face * angle;
        }
    }
    Smooth {
        values: sums.into_iter().map(world).collect(),
        indices: mesh.triangles.iter().map(order).collect(),
    }
}
