//! Walks the tree along a line, from block to block.

use super::Tree;
use super::box_ray::BoxRay;
use super::kernel::Kernel;
use super::node::{Block, Child, LANES, Links};
use super::stack::{LANE, Stack, latest};
use crate::geometry::line::Line;
use crate::geometry::triangle::Passage;

/// What a walk is for.
pub(super) trait Visitor {
    /// Looks at the candidates of a block; says where the walk may end, if
    /// that has changed.
    fn visit(&mut self, met: Met<'_, impl Kernel>) -> Option<f32>;
}

/// A block and which of its triangles the line may pierce.
pub(super) struct Met<'a, K: Kernel> {
    kernel: K,
    pub(super) line: &'a Line,
    lanes: &'a K::Lanes,
    pub(super) block: &'a Block,
    pub(super) index: usize,
    candidates: u32,
    seen: K::Seen,
}

impl<K: Kernel> Met<'_, K> {
    /// Tells each passage and its lane.
    #[inline(always)]
    pub(super) fn each(&self, mut each: impl FnMut(Passage, usize)) {
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

/// Visits the blocks that a line may meet between `low` and the limit that
/// visits return, about nearest first.
pub(super) struct Walk<'a, K: Kernel> {
    kernel: K,
    tree: &'a Tree,
    boxes: K::Boxes,
    limit: f32,
    last: i32,
    stack: &'a mut Stack,
}

impl<'a, K: Kernel> Walk<'a, K> {
    #[inline(always)]
    pub(super) fn new(
        kernel: K,
        tree: &'a Tree,
        ray: &BoxRay,
        low: f32,
        stack: &'a mut Stack,
    ) -> Self {
        stack.clear();
        let (limit, last) = (f32::INFINITY, latest(f32::INFINITY));
        Self { kernel, tree, boxes: kernel.boxes(ray, low), limit, last, stack }
    }

    #[inline(always)]
    pub(super) fn run(mut self, line: &Line, ray: &BoxRay, visitor: &mut impl Visitor) {
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
