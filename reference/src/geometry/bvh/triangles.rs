//! Triangles and rays without optics, for benchmarks and for tools.

use super::{Detected, Instructions, Query, Stack, Tree, TriangleHit};
use crate::geometry::line::Line;
use crate::geometry::soup::Soup;
use glam::DVec3;
use scenes::Ray;
use std::sync::Arc;

/// A soup of triangles and the tree over it. A clone, such as each thread needs
/// one, shares the tree.
#[derive(Clone, Debug)]
pub struct Triangles {
    tree: Arc<Tree>,
    instructions: Detected,
    stack: Stack,
}

/// Where a ray pierces a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, metres.
    pub t: f64,
    /// Index of the triangle.
    pub triangle: u32,
    /// Weights of its corners, ≥ 0, sum 1.
    pub barycentric: [f64; 3],
    /// The ray goes against the triangle's normal.
    pub entering: bool,
}

impl Triangles {
    /// Builds the tree over triangles given by their corners, metres; at most
    /// 2²⁸ of them.
    #[must_use]
    pub fn build(corners: &[[DVec3; 3]]) -> Self {
        let tree = Arc::new(Tree::build(&Soup::of_corners(corners)));
        Self { instructions: tree.instructions, tree, stack: Stack::default() }
    }

    /// Answers from now on with these instructions, if the CPU has them.
    pub fn use_instructions(&mut self, instructions: Instructions) {
        if let Some(detected) = Detected::new(instructions) {
            self.instructions = detected;
        }
    }

    /// The first crossing with 0 < t ≤ `t_max_m` that is not with triangle
    /// `skip` (`u32::MAX` for none). Among equal t the smaller index wins.
    /// The ray's direction must be a unit vector.
    #[inline]
    pub fn closest(&mut self, ray: &Ray, skip: u32, t_max_m: f64) -> Option<Hit> {
        let line = Line::new(ray.origin, ray.direction);
        let query = Query { skip, after: (0.0, u32::MAX) };
        let found = self.tree.closest_by(self.instructions, &line, query, &mut self.stack).first;
        found.map(Hit::from).filter(|hit| hit.t <= t_max_m)
    }

    /// Every crossing of the full line, before and behind the origin, in no
    /// particular order.
    pub fn all(&self, ray: &Ray, mut each: impl FnMut(Hit)) {
        self.tree.crossings(&Line::new(ray.origin, ray.direction), |hit| each(hit.into()));
    }

    /// Memory held, bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.tree.bytes()
    }
}

impl From<TriangleHit> for Hit {
    #[inline]
    fn from(hit: TriangleHit) -> Self {
        let pierce = hit.pierce;
        let (t, barycentric) = (pierce.t, pierce.weights);
        Self { t, triangle: hit.id, barycentric, entering: pierce.entering }
    }
}
