//! What the tree is made of: nodes of eight boxes, and blocks of triangles.

use crate::geometry::line::Line;
use crate::geometry::triangle::{Passage, Triangle};
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
    pub(crate) links: Links,
}

impl Node {
    pub(crate) const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
        links: Links { first_node: 0, first_block: 0, nodes: 0 },
    };
}

/// Where the children of a node are: first those that are nodes, then those that
/// are blocks, each kind in a row. So what a child is and where it lies is known
/// without another look at memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Links {
    pub(crate) first_node: u32,
    pub(crate) first_block: u32,
    /// How many children are nodes.
    pub(crate) nodes: u32,
}

impl Links {
    /// To the root alone.
    pub(crate) const ROOT: Self = Self { first_node: 0, first_block: 0, nodes: 1 };

    /// Index of the node that a child is, or of the block.
    #[inline(always)]
    pub(crate) fn child(self, number: u32) -> Child {
        if number < self.nodes {
            Child::Node((self.first_node + number) as usize)
        } else {
            Child::Block((self.first_block + number - self.nodes) as usize)
        }
    }
}

/// What a child is, and its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Child {
    Node(usize),
    Block(usize),
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
