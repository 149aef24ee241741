//! The tree of boxes over all triangles, eight children to a node.
//!
//! obvhs finds a good binary tree; the wide nodes, the layout and the order of
//! the triangles are ours. Boxes are f32 and prune only; triangles are f64.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod box_ray;
mod collapse;
mod instructions;
mod kernel;
mod node;
mod search;
mod stack;
mod triangles;
mod walk;

pub(crate) use instructions::Detected;
pub use instructions::Instructions;
pub(crate) use search::{Query, TriangleHit};
pub(crate) use stack::Stack;
pub use triangles::{Hit, Triangles};

use crate::geometry::soup::Soup;
use crate::geometry::triangle::Triangle;
use collapse::{Costs, Subtree};
use glam::DVec3;
use node::{Block, LANES, Links, Node, Unit};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use rayon::prelude::*;

/// Most triangles one scene can have.
pub(crate) const MOST_TRIANGLES: usize = 1 << 28;

/// Triangles in the order of the leaves, and the nodes above them.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    blocks: Vec<Block>,
    unit: Unit,
    count: usize,
    pub(crate) instructions: Detected,
}

impl Default for Tree {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            blocks: Vec::new(),
            unit: Unit::default(),
            count: 0,
            instructions: Detected::best(),
        }
    }
}

impl Tree {
    /// Builds the tree; the number of triangles is at most [`MOST_TRIANGLES`].
    /// Triangles with a corner that is not finite are left out.
    pub(crate) fn build(soup: &Soup) -> Self {
        let triangles = Finite::of(soup);
        let mut tree = Self { count: triangles.len(), ..Self::default() };
        if tree.count == 0 {
            return tree;
        }
        let all = || (0..tree.count).into_par_iter().map(|i| triangles.get(i));
        let (low, high) = all()
            .map(|t| bounds(&t))
            .reduce(|| (DVec3::INFINITY, DVec3::NEG_INFINITY), |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let unit = Unit::around(low, high);
        let boxes: Vec<Aabb> = all().map(|t| unit_box(&t, &unit)).collect();
        tree.unit = unit;
        let bvh = build_bvh2(&boxes, parameters(boxes.len()), &mut std::time::Duration::default());
        drop(boxes);
        tree.fill(&bvh, &triangles);
        tree
    }

    /// Copies the best wide form of a binary tree, depth first, so that what is
    /// visited together lies together.
    fn fill(&mut self, bvh: &Bvh2, triangles: &Finite<'_>) {
        let costs = Costs::new(bvh);
        // About a third of the triangles are blocks, and a sixth of those nodes.
        // Room that is never written to takes no memory; growing would take twice.
        self.blocks.reserve_exact(self.count / 2 + 1);
        self.nodes.reserve_exact(self.count / 8 + 1);
        self.nodes.push(Node::EMPTY);
        let mut todo = vec![(costs.subtree(0), 0)];
        while let Some((subtree, mine)) = todo.pop() {
            let first = todo.len();
            let (first_node, first_block) = (self.nodes.len() as u32, self.blocks.len() as u32);
            for (i, subtree) in costs.children(subtree).into_iter().enumerate() {
                let bounds = costs.bounds(&subtree);
                let node: &mut Node = &mut self.nodes[mine];
                for axis in 0..3 {
                    node.planes[axis][0][i] = bounds.min[axis];
                    node.planes[axis][1][i] = bounds.max[axis];
                }
                match subtree {
                    Subtree::Block(of) => self.blocks.push(block(&costs, of, triangles)),
                    Subtree::Node(_) => {
                        todo.push((subtree, self.nodes.len()));
                        self.nodes.push(Node::EMPTY);
                    }
                }
            }
            let nodes = self.nodes.len() as u32 - first_node;
            self.nodes[mine].links = Links { first_node, first_block, nodes };
            todo[first..].reverse();
        }
    }

    /// How many triangles.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// The triangle that the tree keeps in a slot.
    #[inline(always)]
    pub(crate) fn triangle(&self, slot: u32) -> Triangle {
        self.blocks[slot as usize / LANES].triangle(slot as usize % LANES)
    }

    /// All triangles, in the order of the tree.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = Triangle> {
        let lanes =
            |block: &'_ Block| (0..LANES).map(|lane| block.triangle(lane)).collect::<Vec<_>>();
        self.blocks.iter().flat_map(lanes).filter(|triangle| triangle.id != u32::MAX)
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        (self.nodes.len() * size_of::<Node>() + self.blocks.len() * size_of::<Block>()) as u64
    }
}

/// The triangles of a soup whose corners are finite.
struct Finite<'a> {
    soup: &'a Soup,
    /// Their numbers, if some are not.
    kept: Option<Vec<u32>>,
}

impl<'a> Finite<'a> {
    fn of(soup: &'a Soup) -> Self {
        let all = 0..soup.len() as u32;
        let finite = |id: &u32| soup.triangle(*id).corners.iter().flatten().all(|x| x.is_finite());
        let whole = all.clone().into_par_iter().all(|id| finite(&id));
        Self { soup, kept: (!whole).then(|| all.filter(finite).collect()) }
    }

    fn len(&self) -> usize {
        self.kept.as_ref().map_or(self.soup.len(), Vec::len)
    }

    fn get(&self, index: usize) -> Triangle {
        self.soup.triangle(self.kept.as_ref().map_or(index as u32, |kept| kept[index]))
    }
}

fn block(costs: &Costs<'_>, indices: Vec<usize>, of: &Finite<'_>) -> Block {
    let mut block = Block::EMPTY;
    let mut list = Vec::with_capacity(LANES);
    costs.triangles(indices, &mut list);
    for (lane, triangle) in list.into_iter().enumerate() {
        block.set(lane, &of.get(triangle as usize));
    }
    block
}

/// How obvhs builds: with more care where it takes no time.
fn parameters(count: usize) -> BvhBuildParams {
    let base = BvhBuildParams { max_prims_per_leaf: 1, ..BvhBuildParams::medium_build() };
    if count > 1_000_000 {
        return base;
    }
    BvhBuildParams { reinsertion_batch_ratio: 0.5, ..base }
}

fn bounds(triangle: &Triangle) -> (DVec3, DVec3) {
    let [a, b, c] = [0, 1, 2].map(|i| triangle.corner(i));
    (a.min(b).min(c), a.max(b).max(c))
}

/// The box of a triangle in unit coordinates, rounded outwards.
fn unit_box(triangle: &Triangle, unit: &Unit) -> Aabb {
    // Not to the next number: next to zero those are subnormal, and slow.
    const LEAST: f32 = 1e-18;
    let (low, high) = bounds(triangle);
    let down = unit.of(low).as_vec3a();
    let up = unit.of(high).as_vec3a();
    let [below, above] = [down, up].map(|x| x.abs() * f32::EPSILON + LEAST);
    Aabb::new(down - below, up + above)
}
