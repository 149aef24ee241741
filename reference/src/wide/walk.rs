//! Walks the tree: the closest crossing of a ray, or every crossing of a line.
//!
//! Boxes only prune. What is answered depends on the triangles alone, and ties
//! in t go to the smaller id, so every tree and every order of traversal
//! answers with the same bits.

use super::Tree;
use super::instructions::Detected;
use super::kernel::{Job, Kernel};
use super::node::{Block, Child, LANES, Node, WIDTH};
use super::ray::BoxRay;
use super::stack::{Entry, Stack};
use crate::line::Line;
use crate::triangle::Pierce;

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
        instructions.run(Nearest { tree: self, line, query, stack })
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
    fn visit(&mut self, index: usize, block: &Block, candidates: u32) -> Option<f32>;
}

struct Nearest<'a> {
    tree: &'a Tree,
    line: &'a Line,
    query: Query,
    stack: &'a mut Stack,
}

impl Job for Nearest<'_> {
    type Output = Closest;

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) -> Closest {
        let Self { tree, line, query, stack } = self;
        let ray = BoxRay::new(line, &tree.unit);
        let low = ray.not_after(query.after.0);
        let found = Closest { first: None, second_t: f64::INFINITY };
        let first_key = (f64::INFINITY, u32::MAX);
        let mut visitor = VisitNearest { line, ray: &ray, query, found, first_key };
        walk(kernel, tree, line, &ray, low, stack, &mut visitor);
        visitor.found
    }
}

struct VisitNearest<'a> {
    line: &'a Line,
    ray: &'a BoxRay,
    query: Query,
    found: Closest,
    first_key: (f64, u32),
}

impl Visitor for VisitNearest<'_> {
    #[inline(always)]
    fn visit(&mut self, index: usize, block: &Block, candidates: u32) -> Option<f32> {
        let mut limit = None;
        each_pierced(self.line, index, block, candidates, |hit| {
            let t = hit.pierce.t;
            let key = (t, hit.id);
            if hit.id == self.query.skip || key <= self.query.after {
                return;
            }
            if key < self.first_key {
                self.found.second_t = self.first_key.0;
                self.first_key = key;
                self.found.first = Some(hit);
                limit = Some(self.ray.not_before(t + self.line.rounding_at(t)));
            } else if t < self.found.second_t {
                self.found.second_t = t;
            }
        });
        limit
    }
}

struct All<'a, F> {
    tree: &'a Tree,
    line: &'a Line,
    each: F,
}

impl<F: FnMut(TriangleHit)> Job for All<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) {
        let Self { tree, line, each } = self;
        let ray = BoxRay::new(line, &tree.unit);
        let mut visitor = VisitAll { line, each };
        let mut stack = Stack::default();
        walk(kernel, tree, line, &ray, f32::NEG_INFINITY, &mut stack, &mut visitor);
    }
}

struct VisitAll<'a, F> {
    line: &'a Line,
    each: F,
}

impl<F: FnMut(TriangleHit)> Visitor for VisitAll<'_, F> {
    #[inline(always)]
    fn visit(&mut self, index: usize, block: &Block, candidates: u32) -> Option<f32> {
        each_pierced(self.line, index, block, candidates, &mut self.each);
        None
    }
}

/// The crossings with those of a block's triangles that a kernel proposed.
#[inline(always)]
fn each_pierced(
    line: &Line,
    index: usize,
    block: &Block,
    mut candidates: u32,
    mut each: impl FnMut(TriangleHit),
) {
    while candidates != 0 {
        let lane = candidates.trailing_zeros() as usize % LANES;
        candidates &= candidates - 1;
        if let Some(pierce) = Pierce::new(line, |corner, axis| block.corners[corner][axis][lane]) {
            let slot = (index * LANES + lane) as u32;
            each(TriangleHit { pierce, id: block.ids[lane], body: block.bodies[lane], slot });
        }
    }
}

/// Visits the blocks that the line may meet between `low` and the limit that
/// visits return, about nearest first.
#[inline(always)]
fn walk<K: Kernel>(
    kernel: K,
    tree: &Tree,
    line: &Line,
    ray: &BoxRay,
    low: f32,
    stack: &mut Stack,
    visitor: &mut impl Visitor,
) {
    let boxes = kernel.boxes(ray, low);
    let lanes = kernel.lanes(line);
    let mut limit = f32::INFINITY;
    stack.clear();
    let Some(root) = tree.root.filter(|_| ray.is_usable()) else { return };
    let mut child = root;
    loop {
        while !child.is_block() {
            let node = &tree.nodes[child.index()];
            let (mask, near) = kernel.meet(&boxes, node, limit);
            if mask == 0 {
                break;
            }
            child = nearest(node, mask, &near, stack);
        }
        if child.is_block() {
            let block = &tree.blocks[child.index()];
            let mask = kernel.candidates(&lanes, block);
            if mask != 0
                && let Some(closer) = visitor.visit(child.index(), block, mask)
            {
                limit = closer;
            }
        }
        child = loop {
            let Some(entry) = stack.pop() else { return };
            if entry.near() <= limit {
                break entry.child();
            }
        };
    }
}

/// The nearest child of a node; the others go onto the stack, nearest on top.
#[inline(always)]
fn nearest(node: &Node, mut mask: u32, near: &[f32; WIDTH], stack: &mut Stack) -> Child {
    let mut next = || {
        let i = mask.trailing_zeros() as usize % WIDTH;
        mask &= mask - 1;
        (i, mask == 0)
    };
    let entry = |i: usize| Entry::new(near[i], node.children[i]);
    let (first, last) = next();
    if last {
        return node.children[first];
    }
    let a = entry(first);
    let (i, last) = next();
    let b = entry(i);
    let (a, b) = (a.min(b), a.max(b));
    if last {
        stack.push(b);
        return a.child();
    }
    let (i, last) = next();
    let c = entry(i);
    let (b, c) = (b.min(c), b.max(c));
    let (a, b) = (a.min(b), a.max(b));
    if last {
        stack.push(c);
        stack.push(b);
        return a.child();
    }
    let mut sorted = [a, b, c, c, c, c, c, c];
    let mut count = 3;
    loop {
        let (i, last) = next();
        let entry = entry(i);
        let mut at = count;
        while at > 0 && sorted[(at - 1) % WIDTH] > entry {
            sorted[at % WIDTH] = sorted[(at - 1) % WIDTH];
            at -= 1;
        }
        sorted[at % WIDTH] = entry;
        count += 1;
        if last {
            break;
        }
    }
    for entry in sorted[1..count].iter().rev() {
        stack.push(*entry);
    }
    sorted[0].child()
}
