//! What the tree is made of: nodes of eight boxes, and blocks of triangles.

use super::stack::LANE;
use crate::line::Line;
use crate::triangle::{Passage, Triangle};
use glam::DVec3;

/// Children of a node.
pub(crate) const WIDTH: usize = 8;
/// Triangles of a block.
pub(crate) const LANES: usize = 4;

/// Eight children and their boxes, in the tree's unit coordinates.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// By axis: lower and upper planes of the children. Where there is no
    /// child the planes are swapped and infinite, so that no ray passes.
    pub(crate) planes: [[[f32; WIDTH]; 2]; 3],
    pub(crate) children: [Child; WIDTH],
}

impl Node {
    pub(crate) const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
        children: [Child(0); WIDTH],
    };

    /// The child that a key is of.
    #[inline(always)]
    pub(crate) fn child(&self, key: i32) -> Child {
        self.children[(key & LANE) as usize]
    }
}

/// A node's or, with the highest bit set, a block's index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(pub(crate) u32);

const BLOCK: u32 = 1 << 31;

impl Child {
    pub(crate) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(crate) fn block(index: usize) -> Self {
        Self(BLOCK | index as u32)
    }

    #[inline(always)]
    pub(crate) fn is_block(self) -> bool {
        self.0 & BLOCK != 0
    }

    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 & !BLOCK) as usize
    }
}

/// Triangles of one leaf, coordinate by coordinate. Unused lanes are NaN, which
/// no line pierces.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Block {
    /// By corner and axis; world space, metres.
    pub(crate) corners: [[[f64; LANES]; 3]; 3],
    pub(crate) ids: [u32; LANES],
    pub(crate) bodies: [u32; LANES],
}

impl Block {
    pub(crate) const EMPTY: Self = Self {
        corners: [[[f64::NAN; LANES]; 3]; 3],
        ids: [u32::MAX; LANES],
        bodies: [u32::MAX; LANES],
    };

    pub(crate) fn set(&mut self, lane: usize, triangle: &Triangle) {
        for (corner, from) in self.corners.iter_mut().zip(triangle.corners) {
            for (axis, x) in corner.iter_mut().zip(from) {
                axis[lane] = x;
            }
        }
        self.ids[lane] = triangle.id;
        self.bodies[lane] = triangle.body;
    }

    /// A line's passage through a triangle. Seldom needed: kernels know most.
    #[cold]
    #[inline(never)]
    pub(crate) fn passage(&self, line: &Line, lane: usize) -> Option<Passage> {
        Passage::new(line, |corner, axis| self.corners[corner][axis][lane])
    }

    #[inline(always)]
    pub(crate) fn triangle(&self, lane: usize) -> Triangle {
        let corners = self.corners.map(|corner| corner.map(|axis| axis[lane]));
        Triangle { corners, id: self.ids[lane], body: self.bodies[lane] }
    }
}

/// Coordinates in which the boxes of the tree lie within [-1, 1]: f32 resolves
/// them equally well wherever and however large the scene is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unit {
    pub(crate) centre: DVec3,
    /// A power of two, so that scaling is exact.
    pub(crate) per_metre: f64,
}

impl Default for Unit {
    fn default() -> Self {
        Self { centre: DVec3::ZERO, per_metre: 1.0 }
    }
}

impl Unit {
    pub(crate) fn around(low: DVec3, high: DVec3) -> Self {
        let centre = 0.5 * low + 0.5 * high;
        let radius_m = (high - centre).max(centre - low).max_element();
        // The next power of two above; one more for rounding.
        let exponent = radius_m.max(f64::MIN_POSITIVE).log2().floor() as i32 + 1;
        Self { centre, per_metre: 2f64.powi(-exponent.clamp(-1000, 1022)) }
    }

    #[inline(always)]
    pub(crate) fn of(&self, point: DVec3) -> DVec3 {
        (point - self.centre) * self.per_metre
    }
}
