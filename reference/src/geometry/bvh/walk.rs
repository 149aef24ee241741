//! Walks the tree: the closest crossing of a ray, or every crossing of a line.
//!
//! Boxes only prune. What is answered depends on the triangles alone, and ties
//! in t go to the smaller id, so every tree and every order of traversal
//! answers with the same bits.

use super::Tree;
use super::box_ray::BoxRay;
use super::instructions::Detected;
use super::kernel::{Kernel, Traversal};
use super::node::{Block, Child, LANES, Links};
use super::stack::{LANE, Stack, latest};
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

/// What a walk is for.
trait Visitor {
    /// Looks at the candidates of a block; says where the walk may end, if
    /// that has changed.
    fn visit(&mut self, met: Met<'_, impl Kernel>) -> Option<f32>;
}

/// A block and which of its triangles the line may pierce.
struct Met<'a, K: Kernel> {
    kernel: K,
    line: &'a Line,
    lanes: &'a K::Lanes,
    block: &'a Block,
    index: usize,
    candidates: u32,
    seen: K::Seen,
}

impl<K: Kernel> Met<'_, K> {
    /// Tells each passage and its lane.
    #[inline(always)]
    fn each(&self, mut each: impl FnMut(Passage, usize)) {
        let (clear, passages) = self.kernel.clear(self.lanes, &self.seen);
        let mut candidates = self.candidates;
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize % LANES;
            candidates &= candidates - 1;
            if clear >> lane & 1 != 0 {
                each(passages.of(lane), lane);
            } else if let Some(passage) = self.block.passage(self.line, lane) {
                each(passage, lane);
            }
        }
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

/// Visits the blocks that a line may meet between `low` and the limit that
/// visits return, about nearest first.
struct Walk<'a, K: Kernel> {
    kernel: K,
    tree: &'a Tree,
    boxes: K::Boxes,
    limit: f32,
    last: i32,
    stack: &'a mut Stack,
}

impl<'a, K: Kernel> Walk<'a, K> {
    #[inline(always)]
    fn new(kernel: K, tree: &'a Tree, ray: &BoxRay, low: f32, stack: &'a mut Stack) -> Self {
        stack.clear();
        let (limit, last) = (f32::INFINITY, latest(f32::INFINITY));
        Self { kernel, tree, boxes: kernel.boxes(ray, low), limit, last, stack }
    }

    #[inline(always)]
    fn run(mut self, line: &Line, ray: &BoxRay, visitor: &mut impl Visitor) {
        let (kernel, lanes) = (self.kernel, &self.kernel.lanes(line));
        let mut next = (!self.tree.nodes.is_empty() && ray.is_usable()).then_some((Links::ROOT, 0));
        while let Some(index) = next.and_then(|(links, number)| self.down(links, number)) {
            let block = &self.tree.blocks[index];
            let (candidates, seen) = kernel.candidates(lanes, block);
            if candidates != 0 {
                let met = Met { kernel, line, lanes, block, index, candidates, seen };
                if let Some(limit) = visitor.visit(met) {
                    (self.limit, self.last) = (limit, latest(limit));
                }
            }
            next = self.waiting();
        }
    }

    /// Index of the next block: a node's child, or one below it, or one that waits.
    #[inline(always)]
    fn down(&mut self, mut links: Links, mut number: u32) -> Option<usize> {
        let (nodes, limit) = (self.tree.nodes.as_slice(), self.limit);
        loop {
            let node = match links.child(number) {
                Child::Node(index) => &nodes[index],
                Child::Block(index) => return Some(index),
            };
            let (mask, keys) = self.kernel.meet(&self.boxes, node, limit);
            if mask & mask.wrapping_sub(1) != 0 {
                let (key, others) = self.kernel.nearest(keys);
                self.kernel.store(others, self.stack.push(node.links));
                (links, number) = (node.links, lane(key));
            } else if mask != 0 {
                // The only one: which it is need not wait for the keys.
                (links, number) = (node.links, mask.trailing_zeros());
            } else {
                (links, number) = self.waiting()?;
            }
        }
    }

    /// The child to go on with that was met first.
    #[inline(always)]
    fn waiting(&mut self) -> Option<(Links, u32)> {
        loop {
            let siblings = self.stack.top()?;
            let (key, others) = self.kernel.nearest(self.kernel.load(&siblings.keys));
            if key <= self.last {
                self.kernel.store(others, &mut siblings.keys);
                return Some((siblings.links, lane(key)));
            }
            self.stack.pop();
        }
    }
}

/// Which child a key is of.
#[inline(always)]
fn lane(key: i32) -> u32 {
    (key & LANE) as u32
}
