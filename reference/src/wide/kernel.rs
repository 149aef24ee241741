//! The two inner loops, and how they are done without vector instructions.
//!
//! Kernels only propose: [`Pierce::new`](crate::triangle::Pierce::new)
//! decides. For triangles all of them do the same operations in the same order,
//! so they propose the same; for boxes they may round differently, because what
//! is answered does not depend on boxes.

use super::node::{Block, LANES, Node, WIDTH};
use super::ray::BoxRay;
use crate::line::Line;

/// What runs on a kernel, whichever it is.
pub(crate) trait Job {
    type Output;

    fn run<K: Kernel>(self, kernel: K) -> Self::Output;
}

/// One way to run the inner loops.
pub(crate) trait Kernel: Copy {
    /// A line prepared for boxes.
    type Boxes: Copy;
    /// A line prepared for triangles.
    type Lanes: Copy;

    fn boxes(self, ray: &BoxRay, low: f32) -> Self::Boxes;

    fn lanes(self, line: &Line) -> Self::Lanes;

    /// One bit for each child that the line meets between `low` and `limit`,
    /// and where it does.
    fn meet(self, ray: &Self::Boxes, node: &Node, limit: f32) -> (u32, [f32; WIDTH]);

    /// One bit for each triangle that the line may pierce: none that it does is
    /// left out.
    fn candidates(self, line: &Self::Lanes, block: &Block) -> u32;
}

/// Plain Rust.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Kernel for Portable {
    type Boxes = (BoxRay, f32);
    type Lanes = Line;

    #[inline(always)]
    fn boxes(self, ray: &BoxRay, low: f32) -> Self::Boxes {
        (*ray, low)
    }

    #[inline(always)]
    fn lanes(self, line: &Line) -> Line {
        *line
    }

    #[inline(always)]
    fn meet(self, (ray, low): &Self::Boxes, node: &Node, limit: f32) -> (u32, [f32; WIDTH]) {
        let (mut near, mut far) = ([*low; WIDTH], [limit; WIDTH]);
        for axis in 0..3 {
            let first = ray.first[axis] & 1;
            let (enter, leave) = (&node.planes[axis][first], &node.planes[axis][first ^ 1]);
            for i in 0..WIDTH {
                let t = enter[i] * ray.inverse[axis] + ray.enter[axis];
                near[i] = if t > near[i] { t } else { near[i] };
                let t = leave[i] * ray.inverse[axis] + ray.leave[axis];
                far[i] = if t < far[i] { t } else { far[i] };
            }
        }
        let mut mask = 0;
        for i in 0..WIDTH {
            mask |= u32::from(near[i] <= far[i]) << i;
        }
        (mask, near)
    }

    #[inline(always)]
    fn candidates(self, line: &Line, block: &Block) -> u32 {
        let [x, y, z] = line.axes;
        let mut across = [[[0.0; LANES]; 2]; 3];
        for (corner, seen) in block.corners.iter().zip(&mut across) {
            for i in 0..LANES {
                let depth = corner[z][i] - line.origin[z];
                seen[0][i] = (corner[x][i] - line.origin[x]) - line.shear.x * depth;
                seen[1][i] = (corner[y][i] - line.origin[y]) - line.shear.y * depth;
            }
        }
        let [a, b, c] = &across;
        let mut mask = 0;
        for i in 0..LANES {
            let cross = |p: &[[f64; LANES]; 2], q: &[[f64; LANES]; 2]| {
                p[0][i] * q[1][i] - p[1][i] * q[0][i]
            };
            let [u, v, w] = [cross(c, b), cross(a, c), cross(b, a)];
            let all = (u >= 0.0) & (v >= 0.0) & (w >= 0.0);
            let none = (u <= 0.0) & (v <= 0.0) & (w <= 0.0);
            mask |= u32::from(all | none) << i;
        }
        mask
    }
}
