//! The tree of padded boxes over all triangles.
//!
//! obvhs finds a good topology; the boxes, the layout and the order of the
//! triangles are ours. Boxes are f32, rounded outwards and padded by 4 ulp of
//! the scene, which is far more than f64 rounding along a ray can move.

use crate::triangle::Triangle;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use rayon::prelude::*;
use std::ops::Range;

/// Two children and their boxes.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Node {
    pub(crate) low: [[f32; 3]; 2],
    pub(crate) high: [[f32; 3]; 2],
    pub(crate) children: [u32; 2],
}

/// What a packed child stands for.
pub(crate) enum Child {
    Inner(usize),
    Leaf(Range<usize>),
}

const LEAF: u32 = 1 << 31;
const COUNT_BITS: u32 = 3;
/// Triangles per leaf that the packing can hold.
const MOST_PER_LEAF: u32 = 1 << COUNT_BITS;

/// Most triangles one scene can have.
pub(crate) const MOST_TRIANGLES: usize = 1 << (31 - COUNT_BITS);

impl Child {
    #[inline(always)]
    pub(crate) fn unpack(code: u32) -> Self {
        if code & LEAF == 0 {
            return Self::Inner(code as usize);
        }
        let first = ((code & !LEAF) >> COUNT_BITS) as usize;
        Self::Leaf(first..first + (code & (MOST_PER_LEAF - 1)) as usize + 1)
    }

    fn pack_leaf(first: usize, count: u32) -> u32 {
        LEAF | ((first as u32) << COUNT_BITS) | (count - 1)
    }
}

/// Triangles in the order of the leaves, and the nodes above them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) root: Option<u32>,
}

impl Tree {
    /// Builds the tree; the number of triangles is at most [`MOST_TRIANGLES`].
    pub(crate) fn build(triangles: Vec<Triangle>) -> Self {
        if triangles.is_empty() {
            return Self::default();
        }
        let largest = triangles.par_iter().map(largest_coordinate).reduce(|| 0.0, f64::max);
        let pad = largest * 4.0 * f64::from(f32::EPSILON);
        let boxes: Vec<Aabb> = triangles.par_iter().map(|t| padded_box(t, pad)).collect();
        let params = BvhBuildParams { max_prims_per_leaf: 4, ..BvhBuildParams::medium_build() };
        let bvh = build_bvh2(&boxes, params, &mut std::time::Duration::default());
        drop(boxes);
        let mut tree = Self {
            nodes: Vec::with_capacity(bvh.nodes.len() / 2),
            triangles: Vec::with_capacity(triangles.len()),
            root: None,
        };
        tree.root = Some(tree.copy(&bvh, &triangles));
        tree
    }

    /// Copies obvhs's nodes depth first, so that a child often follows its
    /// parent in memory, and the triangles with them.
    fn copy(&mut self, bvh: &Bvh2, triangles: &[Triangle]) -> u32 {
        // (obvhs node, where its code goes: our node and side)
        let mut todo: Vec<(usize, Option<(usize, usize)>)> = vec![(0, None)];
        let mut root = 0;
        while let Some((index, target)) = todo.pop() {
            let node = &bvh.nodes[index];
            let code = if node.prim_count > 0 {
                self.copy_leaf(bvh, node.first_index, node.prim_count, triangles)
            } else {
                let mine = self.nodes.len();
                let kids = [node.first_index as usize, node.first_index as usize + 1];
                let boxes = kids.map(|kid| *bvh.nodes[kid].aabb());
                self.nodes.push(Node {
                    low: boxes.map(|b| b.min.to_array()),
                    high: boxes.map(|b| b.max.to_array()),
                    children: [0; 2],
                });
                todo.push((kids[1], Some((mine, 1))));
                todo.push((kids[0], Some((mine, 0))));
                mine as u32
            };
            match target {
                Some((parent, side)) => self.nodes[parent].children[side] = code,
                None => root = code,
            }
        }
        root
    }

    /// A leaf, or a chain of small nodes where obvhs put more triangles into
    /// one than the packing holds.
    fn copy_leaf(&mut self, bvh: &Bvh2, first: u32, count: u32, triangles: &[Triangle]) -> u32 {
        let take = count.min(MOST_PER_LEAF);
        let start = self.triangles.len();
        for i in first..first + take {
            self.triangles.push(triangles[bvh.primitive_indices[i as usize] as usize]);
        }
        let leaf = Child::pack_leaf(start, take);
        if take == count {
            return leaf;
        }
        let everywhere = [[f32::NEG_INFINITY; 3]; 2];
        let mine = self.nodes.len();
        self.nodes.push(Node {
            low: everywhere,
            high: [[f32::INFINITY; 3]; 2],
            children: [leaf, 0],
        });
        let rest = self.copy_leaf(bvh, first + take, count - take, triangles);
        self.nodes[mine].children[1] = rest;
        mine as u32
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        (self.nodes.capacity() * size_of::<Node>()
            + self.triangles.capacity() * size_of::<Triangle>()) as u64
    }
}

fn largest_coordinate(triangle: &Triangle) -> f64 {
    triangle.corners.iter().flatten().fold(0.0, |most, x| x.abs().max(most))
}

fn padded_box(triangle: &Triangle, pad: f64) -> Aabb {
    let [a, b, c] = [0, 1, 2].map(|i| triangle.corner(i));
    let low = a.min(b).min(c) - pad;
    let high = a.max(b).max(c) + pad;
    let down = low.to_array().map(|x| (x as f32).next_down());
    let up = high.to_array().map(|x| (x as f32).next_up());
    Aabb::new(down.into(), up.into())
}
