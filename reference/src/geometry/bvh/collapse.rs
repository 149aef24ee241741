//! From obvhs's binary tree to nodes of eight children and full blocks.
//!
//! Which subtrees become children, and which become blocks, is the choice of
//! least expected cost under the surface area heuristic. Source: H. Ylitie,
//! T. Karras, S. Laine, "Efficient Incoherent Ray Traversal on GPUs Through
//! Compressed Wide BVHs", HPG 2017, §3.1.

use super::node::{LANES, WIDTH};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;

/// Time of a block relative to that of a node.
const BLOCK_COST: f32 = 0.35;

/// What a block less is worth beside fewer visits, of the visits of two: memory,
/// at no time that could be measured.
const FULLNESS: f32 = 0.15;

/// For each node of the binary tree, the least cost of the triangles below it
/// as a forest of 1 to 7 trees.
pub(crate) struct Costs<'a> {
    bvh: &'a Bvh2,
    costs: Vec<[f32; WIDTH - 1]>,
    counts: Vec<u8>,
}

/// A subtree as it will be a child.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Subtree {
    /// All triangles below these binary nodes.
    Block(Vec<usize>),
    /// A wide node in place of this binary node.
    Node(usize),
}

impl<'a> Costs<'a> {
    pub(crate) fn new(bvh: &'a Bvh2) -> Self {
        let count = bvh.nodes.len();
        let mut this = Self { bvh, costs: vec![[0.0; WIDTH - 1]; count], counts: vec![0; count] };
        for index in children_first(bvh) {
            this.weigh(index as usize);
        }
        this
    }

    fn weigh(&mut self, index: usize) {
        let node = &self.bvh.nodes[index];
        let area = node.aabb().half_area();
        if node.is_leaf() {
            self.counts[index] = node.prim_count.min(u8::MAX as u32) as u8;
            self.costs[index] = [area * BLOCK_COST; WIDTH - 1];
            return;
        }
        let kids = self.kids(index);
        self.counts[index] = self.counts[kids[0]].saturating_add(self.counts[kids[1]]);
        let block = if usize::from(self.counts[index]) <= LANES {
            area * BLOCK_COST
        } else {
            f32::INFINITY
        };
        let mut costs = [0.0; WIDTH - 1];
        costs[0] = block.min(area + self.forest(kids, WIDTH).0);
        for trees in 2..WIDTH {
            costs[trees - 1] = costs[trees - 2].min(self.forest(kids, trees).0);
        }
        self.costs[index] = costs;
    }

    fn kids(&self, index: usize) -> [usize; 2] {
        let first = self.bvh.nodes[index].first_index as usize;
        [first, first + 1]
    }

    /// Least cost of two subtrees as `trees` trees, and how many the first gets.
    fn forest(&self, [left, right]: [usize; 2], trees: usize) -> (f32, usize) {
        let cost = |i: usize| self.costs[left][i - 1] + self.costs[right][trees - i - 1];
        (1..trees)
            .map(|i| (cost(i), i))
            .fold((f32::INFINITY, 1), |best, next| if next.0 < best.0 { next } else { best })
    }

    /// How a binary node becomes one child.
    pub(crate) fn subtree(&self, index: usize) -> Subtree {
        let fits = usize::from(self.counts[index]) <= LANES;
        let area = self.bvh.nodes[index].aabb().half_area();
        if self.bvh.nodes[index].is_leaf() || (fits && self.costs[index][0] >= area * BLOCK_COST) {
            Subtree::Block(vec![index])
        } else {
            Subtree::Node(index)
        }
    }

    /// The children of the wide node in place of a subtree, nodes first. A block,
    /// which is so only at the root, becomes a node's only child.
    pub(crate) fn children(&self, subtree: Subtree) -> Vec<Subtree> {
        let Subtree::Node(index) = subtree else { return vec![subtree] };
        let mut subtrees = Vec::with_capacity(WIDTH);
        let [left, right] = self.kids(index);
        let (_, share) = self.forest([left, right], WIDTH);
        self.distribute(left, share, &mut subtrees);
        self.distribute(right, WIDTH - share, &mut subtrees);
        while let Some((first, second)) = self.pair(&subtrees) {
            if let Subtree::Block(more) = subtrees.swap_remove(second)
                && let Subtree::Block(indices) = &mut subtrees[first]
            {
                indices.extend(more);
            }
        }
        subtrees.sort_by_key(|subtree| matches!(subtree, Subtree::Block(_)));
        subtrees
    }

    /// The box around a subtree.
    pub(crate) fn bounds(&self, subtree: &Subtree) -> Aabb {
        let of = |index: &usize| *self.bvh.nodes[*index].aabb();
        match subtree {
            Subtree::Node(index) => of(index),
            Subtree::Block(indices) => {
                indices.iter().map(of).reduce(|a, b| a.union(&b)).unwrap_or(Aabb::empty())
            }
        }
    }

    /// Two blocks of a node that fit into one which is met hardly more often than
    /// the two together, those that gain most. The binary tree does not know what
    /// fits: without this, blocks of four hold 2.7 triangles.
    fn pair(&self, subtrees: &[Subtree]) -> Option<(usize, usize)> {
        let blocks: Vec<(usize, usize, Aabb)> = subtrees
            .iter()
            .enumerate()
            .filter_map(|(place, subtree)| {
                let Subtree::Block(indices) = subtree else { return None };
                let count = indices.iter().map(|i| usize::from(self.counts[*i])).sum();
                (count < LANES).then(|| (place, count, self.bounds(subtree)))
            })
            .collect();
        let mut best = None;
        let mut most = 0.0;
        for (i, (first, count, bounds)) in blocks.iter().enumerate() {
            for (second, more, other) in &blocks[i + 1..] {
                let apart = bounds.half_area() + other.half_area();
                let gain = (1.0 + FULLNESS) * apart - bounds.union(other).half_area();
                if count + more <= LANES && gain > most {
                    (best, most) = (Some((*first, *second)), gain);
                }
            }
        }
        best
    }

    fn distribute(&self, index: usize, trees: usize, subtrees: &mut Vec<Subtree>) {
        let costs = &self.costs[index];
        let mut trees = trees;
        while trees > 1 && costs[trees - 2] <= costs[trees - 1] {
            trees -= 1;
        }
        if trees == 1 {
            subtrees.push(self.subtree(index));
            return;
        }
        let [left, right] = self.kids(index);
        let (_, share) = self.forest([left, right], trees);
        self.distribute(left, share, subtrees);
        self.distribute(right, trees - share, subtrees);
    }

    /// The triangles below binary nodes.
    pub(crate) fn triangles(&self, indices: Vec<usize>, into: &mut Vec<u32>) {
        let mut todo = indices;
        while let Some(index) = todo.pop() {
            let node = &self.bvh.nodes[index];
            if node.is_leaf() {
                let first = node.first_index as usize;
                let range = first..first + node.prim_count as usize;
                into.extend_from_slice(&self.bvh.primitive_indices[range]);
            } else {
                todo.extend(self.kids(index));
            }
        }
    }
}

/// Node indices in an order in which children come before parents.
fn children_first(bvh: &Bvh2) -> Vec<u32> {
    let mut order: Vec<u32> = Vec::with_capacity(bvh.nodes.len());
    let mut todo = vec![0_u32];
    while let Some(index) = todo.pop() {
        order.push(index);
        let node = &bvh.nodes[index as usize];
        if !node.is_leaf() {
            todo.extend([node.first_index, node.first_index + 1]);
        }
    }
    order.reverse();
    order
}
