//! Whether a scene is one convex body, so that a ray that has left it is free.

use super::World;
use crate::geometry::triangle::Triangle;
use glam::DVec3;
use scenes::Shape;
use std::collections::HashMap;

impl World {
    /// True when there is exactly one body, transparent, and convex.
    pub(crate) fn is_one_convex_body(&self) -> bool {
        let [body] = self.bodies.as_slice() else { return false };
        if body.class().is_none() {
            return false;
        }
        match self.analytic.as_slice() {
            [analytic] => !matches!(analytic.shape.as_ref(), Shape::Mesh(_)),
            _ => !self.has_a_dent() && self.surface_is_convex(),
        }
    }

    /// Finds most dents without memory: a triangle that clearly stands before
    /// the plane of another one, among those that lie together in the tree.
    fn has_a_dent(&self) -> bool {
        let clearly = 1e-9 * (self.bounds[1] - self.bounds[0]).max_element();
        let before = |plane: &Triangle, triangle: &Triangle| {
            let (normal, from) = (plane.normal(), plane.corner(0));
            (0..3).any(|i| (triangle.corner(i) - from).dot(normal) > clearly)
        };
        let mut pairs = self.tree.triangles().zip(self.tree.triangles().skip(1));
        pairs.any(|(a, b)| before(&a, &b) || before(&b, &a))
    }

    /// Every edge bends outwards, and every line pierces the surface twice at
    /// most (checked for lines through the middle, which a surface that winds
    /// around itself would meet more often).
    fn surface_is_convex(&self) -> bool {
        let key = |p: [f64; 3]| p.map(|x| (x + 0.0).to_bits());
        let size = (self.bounds[1] - self.bounds[0]).max_element();
        let mut across: HashMap<[[u64; 3]; 2], DVec3> = HashMap::new();
        for triangle in self.tree.triangles() {
            for i in 0..3 {
                let [a, b, c] = [0, 1, 2].map(|k| triangle.corners[(i + k) % 3]);
                if across.insert([key(a), key(b)], DVec3::from_array(c)).is_some() {
                    return false;
                }
            }
        }
        let bends_outwards = self.tree.triangles().all(|triangle| {
            let (normal, from) = (triangle.normal(), triangle.corner(0));
            (0..3).all(|i| {
                let ends = [triangle.corners[(i + 1) % 3], triangle.corners[i]].map(key);
                let beyond = across.get(&ends);
                beyond.is_some_and(|p| (*p - from).dot(normal) <= 1e-13 * size)
            })
        });
        bends_outwards && self.middle_is_wound_once()
    }

    fn middle_is_wound_once(&self) -> bool {
        let count = self.tree.len() as f64;
        let sum: DVec3 = self.tree.triangles().map(|t| t.point([1.0 / 3.0; 3])).sum();
        let direction = DVec3::new(0.48, 0.6, 0.64);
        let line = crate::geometry::line::Line::new(sum / count, direction);
        let mut crossings = Vec::new();
        self.all_crossings(&line, &mut crossings);
        crossings.len() == 2
    }
}
