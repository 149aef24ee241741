//! Searches the tree: the closest crossing of a ray, or every crossing of a line.
//!
//! Boxes only prune. What is answered depends on the triangles alone, and ties
//! in t go to the smaller id, so every tree and every order of traversal
//! answers with the same bits.

use super::Tree;
use super::box_ray::BoxRay;
use super::instructions::Detected;
use super::kernel::{Kernel, Traversal};
use super::node::LANES;
use super::stack::Stack;
use super::walk::{Met, Visitor, Walk};
use crate::geometry::line::Line;
use crate::geometry::triangle::{Passage, Pierce};

/// A crossing with a triangle and where the tree keeps it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TriangleHit {
    pub(crate) pierce: Pierce,
    pub(crate) id: u32,
    pub(crate) body: u32,
    pub(crate) slot: u32,
}

/// What part of a line is asked about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Query {
    /// Triangle that the ray has just left; `u32::MAX` for none.
    pub(crate) skip: u32,
    /// Only crossings after this (t, id) count.
    pub(crate) after: (f64, u32),
}

/// The two closest crossings that satisfy a query. The second is exact only
/// where it lies within rounding of the first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closest {
    pub(crate) first: Option<TriangleHit>,
    pub(crate) second_t: f64,
}

impl Tree {
    /// The first crossing after `query.after`, and the t of another one if it
    /// is within rounding of the first.
    #[inline]
    pub(crate) fn closest(&self, line: &Line, query: Query, stack: &mut Stack) -> Closest {
        self.closest_by(self.instructions, line, query, stack)
    }

    /// [`Self::closest`] with other instructions than the best.
    #[inline]
    pub(crate) fn closest_by(
        &self,
        instructions: Detected,
        line: &Line,
        query: Query,
        stack: &mut Stack,
    ) -> Closest {
        // Made here, where the line still is in registers.
        let ray = BoxRay::new(line, &self.unit);
        instructions.run(Nearest { tree: self, line, ray: &ray, query, stack })
    }

    /// What is to be said of a passage through the triangle in a slot.
    #[inline(always)]
    fn hit(&self, slot: u32, passage: Passage) -> TriangleHit {
        let (block, lane) = (&self.blocks[slot as usize / LANES], slot as usize % LANES);
        let (id, body) = (block.ids[lane], block.bodies[lane]);
        TriangleHit { pierce: passage.into(), id, body, slot }
    }

    /// Every crossing of the full line, in no particular order.
    pub(crate) fn crossings(&self, line: &Line, each: impl FnMut(TriangleHit)) {
        self.instructions.run(All { tree: self, line, each });
    }
}

struct Nearest<'a> {
    tree: &'a Tree,
    line: &'a Line,
    ray: &'a BoxRay,
    query: Query,
    stack: &'a mut Stack,
}

impl Traversal for Nearest<'_> {
    type Output = Closest;

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) -> Closest {
        let Self { tree, line, ray, query, stack } = self;
        let low = ray.not_after(query.after.0);
        let key = (f64::INFINITY, u32::MAX);
        let mut visitor = VisitNearest { ray, query, key, first: None, second_t: key.0 };
        Walk::new(kernel, tree, ray, low, stack).run(line, ray, &mut visitor);
        let VisitNearest { first, second_t, .. } = visitor;
        Closest { first: first.map(|(slot, passage)| tree.hit(slot, passage)), second_t }
    }
}

struct VisitNearest<'a> {
    ray: &'a BoxRay,
    query: Query,
    /// t and number of the closest so far.
    key: (f64, u32),
    /// Its slot, and the passage through it.
    first: Option<(u32, Passage)>,
    second_t: f64,
}

impl Visitor for VisitNearest<'_> {
    #[inline(always)]
    fn visit(&mut self, met: Met<'_, impl Kernel>) -> Option<f32> {
        let mut nearer = false;
        met.each(|passage, lane| {
            let key = (passage.t, met.block.ids[lane]);
            if key.1 == self.query.skip || key <= self.query.after {
                return;
            }
            if key < self.key {
                nearer = true;
                self.second_t = self.key.0;
                self.key = key;
                self.first = Some(((met.index * LANES + lane) as u32, passage));
            } else if key.0 < self.second_t {
                self.second_t = key.0;
            }
        });
        let t = self.key.0;
        nearer.then(|| self.ray.not_before(t + met.line.rounding_at(t)))
    }
}

struct All<'a, F> {
    tree: &'a Tree,
    line: &'a Line,
    each: F,
}

impl<F: FnMut(TriangleHit)> Traversal for All<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) {
        let Self { tree, line, each } = self;
        let ray = BoxRay::new(line, &tree.unit);
        let mut stack = Stack::default();
        let walk = Walk::new(kernel, tree, &ray, f32::NEG_INFINITY, &mut stack);
        walk.run(line, &ray, &mut VisitAll { tree, each });
    }
}

struct VisitAll<'a, F> {
    tree: &'a Tree,
    each: F,
}

impl<F: FnMut(TriangleHit)> Visitor for VisitAll<'_, F> {
    #[inline(always)]
    fn visit(&mut self, met: Met<'_, impl Kernel>) -> Option<f32> {
        met.each(|passage, lane| {
            let slot = (met.index * LANES + lane) as u32;
            (self.each)(self.tree.hit(slot, passage));
        });
        None
    }
}
