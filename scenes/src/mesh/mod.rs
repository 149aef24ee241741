//! Triangle meshes in object space, f64.

pub mod distance;
pub mod normals;
pub mod obj;
pub(crate) mod polygon;
pub mod topology;

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

    /// Twice the area times the unit normal of a triangle; zero where it is
    /// degenerate.
    #[must_use]
    pub fn area_vector(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a)
    }

    /// Adds another mesh beside this one; no vertices are merged. Normals are
    /// kept only where both meshes have them.
    pub fn append(&mut self, other: &Self) {
        let moved = |base: usize| {
            move |triangle: &[u32; 3]| triangle.map(|i| i + u32::try_from(base).unwrap_or(u32::MAX))
        };
        let was_empty = self.triangles.is_empty();
        self.triangles.extend(other.triangles.iter().map(moved(self.positions.len())));
        self.positions.extend_from_slice(&other.positions);
        self.normals = match (self.normals.take(), &other.normals) {
            (Some(mut ours), Some(theirs)) => {
                ours.indices.extend(theirs.indices.iter().map(moved(ours.values.len())));
                ours.values.extend_from_slice(&theirs.values);
                Some(ours)
            }
            (None, Some(theirs)) if was_empty => Some(theirs.clone()),
            _ => None,
        };
    }

    /// The same surface with inside and outside exchanged.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        if let Some(normals) = &mut self.normals {
            normals.indices.iter_mut().for_each(|corner| corner.swap(1, 2));
            normals.values.iter_mut().for_each(|n| *n = -*n);
        }
        self
    }

    /// Every position replaced; normals are dropped, because they no longer fit.
    #[must_use]
    pub fn with_positions(mut self, place: impl FnMut(DVec3) -> DVec3) -> Self {
        self.positions = self.positions.into_iter().map(place).collect();
        self.normals = None;
        self
    }
}
