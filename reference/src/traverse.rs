//! Walks the tree of boxes: the closest crossing of a ray, or every crossing
//! of a line.
//!
//! Boxes only prune. What is answered depends on the triangles alone, and ties
//! in t go to the smaller id, so every tree and every order of traversal
//! answers with the same bits.

use crate::line::Line;
use crate::tree::{Child, Node, Tree};
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
    pub(crate) fn closest(&self, line: &Line, query: Query, stack: &mut Stack) -> Closest {
        let mut found = Closest { first: None, second_t: f64::INFINITY };
        let mut first_key = (f64::INFINITY, u32::MAX);
        let mut limit = f64::INFINITY;
        stack.restart(self.root);
        while let Some((child, near)) = stack.pop() {
            if near > limit {
                continue;
            }
            match child {
                Child::Inner(index) => {
                    self.push_children(line, &self.nodes[index], query.after.0, limit, stack);
                }
                Child::Leaf(range) => {
                    for slot in range {
                        let triangle = &self.triangles[slot];
                        let Some(pierce) = triangle.pierce(line) else { continue };
                        let key = (pierce.t, triangle.id);
                        if triangle.id == query.skip || key <= query.after {
                            continue;
                        }
                        if key < first_key {
                            found.second_t = first_key.0;
                            first_key = key;
                            let (id, body) = (triangle.id, triangle.body);
                            found.first = Some(TriangleHit { pierce, id, body, slot: slot as u32 });
                            limit = pierce.t + line.rounding_at(pierce.t);
                        } else if pierce.t < found.second_t {
                            found.second_t = pierce.t;
                        }
                    }
                }
            }
        }
        found
    }

    /// Every crossing of the full line, in no particular order.
    pub(crate) fn crossings(&self, line: &Line, mut each: impl FnMut(TriangleHit)) {
        let mut stack = Stack::default();
        stack.restart(self.root);
        while let Some((child, _)) = stack.pop() {
            match child {
                Child::Inner(index) => {
                    let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
                    self.push_children(line, &self.nodes[index], low, high, &mut stack);
                }
                Child::Leaf(range) => {
                    for slot in range {
                        let triangle = &self.triangles[slot];
                        if let Some(pierce) = triangle.pierce(line) {
                            let (id, body) = (triangle.id, triangle.body);
                            each(TriangleHit { pierce, id, body, slot: slot as u32 });
                        }
                    }
                }
            }
        }
    }

    /// Pushes the children that the line may meet between `low` and `high`,
    /// the nearer one last.
    #[inline(always)]
    fn push_children(&self, line: &Line, node: &Node, low: f64, high: f64, stack: &mut Stack) {
        let (a, b) = (span(line, node, 0, low, high), span(line, node, 1, low, high));
        match (a, b) {
            (Some(a), Some(b)) if a <= b => {
                stack.push(node.children[1], b);
                stack.push(node.children[0], a);
            }
            (Some(a), Some(b)) => {
                stack.push(node.children[0], a);
                stack.push(node.children[1], b);
            }
            (Some(a), None) => stack.push(node.children[0], a),
            (None, Some(b)) => stack.push(node.children[1], b),
            (None, None) => {}
        }
    }
}

/// Where the line enters a child's box, if it may pass it between `low` and
/// `high`. Never misses: rounding is on the side of a hit.
/// Source: T. Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013.
#[inline(always)]
fn span(line: &Line, node: &Node, child: usize, low: f64, high: f64) -> Option<f64> {
    let (mut near, mut far) = (low, high);
    for axis in 0..3 {
        let (origin, inverse) = (line.origin[axis], line.inverse[axis]);
        let at = (f64::from(node.low[child][axis]) - origin) * inverse;
        let to = (f64::from(node.high[child][axis]) - origin) * inverse;
        let (enter, leave) = if inverse < 0.0 { (to, at) } else { (at, to) };
        near = if enter > near { enter } else { near };
        far = if leave < far { leave } else { far };
    }
    (near <= far + far.abs() * (16.0 * f64::EPSILON)).then_some(near)
}

/// Nodes still to visit; grows beyond its fixed part only in hostile trees.
/// Kept between rays, because clearing it would cost as much as a short walk.
#[derive(Clone, Debug)]
pub(crate) struct Stack {
    fixed: [(u32, f64); 64],
    used: usize,
    spill: Vec<(u32, f64)>,
}

impl Default for Stack {
    fn default() -> Self {
        Self { fixed: [(0, 0.0); 64], used: 0, spill: Vec::new() }
    }
}

impl Stack {
    #[inline]
    fn restart(&mut self, root: Option<u32>) {
        self.used = 0;
        self.spill.clear();
        if let Some(root) = root {
            self.push(root, f64::NEG_INFINITY);
        }
    }

    #[inline(always)]
    fn push(&mut self, code: u32, near: f64) {
        if let Some(slot) = self.fixed.get_mut(self.used) {
            *slot = (code, near);
            self.used += 1;
        } else {
            self.spill.push((code, near));
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<(Child, f64)> {
        if let Some((code, near)) = self.spill.pop() {
            return Some((Child::unpack(code), near));
        }
        self.used = self.used.checked_sub(1)?;
        let (code, near) = self.fixed[self.used];
        Some((Child::unpack(code), near))
    }
}
