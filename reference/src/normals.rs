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

/// The mesh's own normals, or angle-weighted means of the adjacent faces where
/// it brings none.
pub(crate) fn smooth_normals(mesh: &Mesh, normal_from_object: DMat3) -> Smooth {
    // A mirrored mesh is baked with its last two corners swapped.
    let mirrored = normal_from_object.determinant() < 0.0;
    let order = |[a, b, c]: &[u32; 3]| if mirrored { [*a, *c, *b] } else { [*a, *b, *c] };
    let world = |n: &DVec3| (normal_from_object * *n).normalize_or_zero();
    let means;
    let normals = match &mesh.normals {
        Some(normals) => normals,
        None => {
            means = scenes::normals::smooth(mesh);
            &means
        }
    };
    Smooth {
        values: normals.values.iter().map(world).collect(),
        indices: normals.indices.iter().map(order).collect(),
    }
}
