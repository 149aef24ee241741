//! Triangle meshes in object space, f64.

use glam::DVec3;

/// An indexed triangle mesh, counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, metres in object space. Welded: one entry per distinct
    /// position, so shared edges share indices.
    pub positions: Vec<DVec3>,
    /// Three position indices per triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normals, if the mesh brings or was given any.
    pub normals: Option<CornerNormals>,
}

/// Normals addressed per triangle corner, so that creases are possible.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CornerNormals {
    /// Unit, object space, outward.
    pub values: Vec<DVec3>,
    /// For each triangle, three indices into `values`.
    pub indices: Vec<[u32; 3]>,
}

impl Mesh {
    /// Positions of a triangle's corners.
    #[must_use]
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|i| self.positions[i as usize])
    }

    /// Corners of the axis-aligned bounding box; inverted infinities when empty.
    #[must_use]
    pub fn bounds(&self) -> [DVec3; 2] {
        self.positions.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| {
            [low.min(*p), high.max(*p)]
        })
    }
}
