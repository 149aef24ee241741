//! Interpolated shading normals in world space.

use glam::{DMat3, DVec3};
use scenes::{Mesh, Shape};
use std::sync::Arc;

/// Unit normals of a mesh. Which three belong to a triangle is left where it is:
/// in the mesh.
#[derive(Clone, Debug)]
pub(crate) struct ShadingNormals {
    values: Vec<DVec3>,
    shape: Arc<Shape>,
    /// A mirrored mesh is baked with its last two corners swapped.
    mirrored: bool,
}

impl ShadingNormals {
    /// Bytes held beside the scene's.
    pub(crate) fn bytes(&self) -> u64 {
        (self.values.capacity() * size_of::<DVec3>()) as u64
    }

    /// The unit normal at a point of a triangle; zero where the three cancel.
    pub(crate) fn at(&self, triangle: usize, weights: [f64; 3]) -> DVec3 {
        let Some(mesh) = self.shape.mesh() else { return DVec3::ZERO };
        let [a, b, c] = mesh.normals.as_ref().map_or(&mesh.triangles, |n| &n.indices)[triangle]
            .map(|i| self.values[i as usize]);
        let [b, c] = if self.mirrored { [c, b] } else { [b, c] };
        (a * weights[0] + b * weights[1] + c * weights[2]).normalize_or_zero()
    }
}

/// The mesh's own normals, or angle-weighted means of the adjacent faces where
/// it brings none; nothing for a shape that is no mesh.
pub(crate) fn shading_normals(
    shape: &Arc<Shape>,
    normal_from_object: DMat3,
) -> Option<ShadingNormals> {
    let world = |n: &DVec3| (normal_from_object * *n).normalize_or_zero();
    let of = |mesh: &Mesh| match &mesh.normals {
        Some(normals) => normals.values.iter().map(world).collect(),
        // One for each vertex, so the triangles themselves say which.
        None => scenes::normals::smooth(mesh).values.iter().map(world).collect(),
    };
    let values = of(shape.mesh()?);
    let mirrored = normal_from_object.determinant() < 0.0;
    Some(ShadingNormals { values, shape: Arc::clone(shape), mirrored })
}
