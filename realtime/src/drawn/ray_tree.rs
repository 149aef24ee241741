//! What rays meet: triangles under a tree of boxes with eight children to a node, and
//! analytic bodies. As ray_tree.wgsl and ray_analytic.wgsl read them.

use crate::drawn::drawables::{Corner, Draw, Drawables};
use crate::drawn::ray_refit::refit;
use bytemuck::{Pod, Zeroable};
use encase::ShaderType;
use glam::{DAffine3, DMat4, Mat4, Vec3, Vec3A, Vec4};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::cwbvh::node::CwBvhNode;
use obvhs::{Boundable, BvhBuildParams};
use std::time::{Duration, Instant};

/// Number of the first opaque surface among bodies.
const OPAQUE: u32 = 16;

/// Share of the largest coordinate by which boxes are widened: what 32 bits lose when a
/// line is set against a box, with room.
const WIDENED: f64 = 1.0 / (1 << 20) as f64;

/// Triangles in the order of the leaves, nodes, and bodies without triangles.
#[derive(Clone, Debug, Default)]
pub(crate) struct RayTree {
    pub(crate) nodes: Vec<CwBvhNode>,
    pub(crate) triangles: Vec<RayTriangle>,
    /// Their bodies; opaque surfaces follow.
    pub(crate) bodies: Vec<u32>,
    /// Interpolated normals of each triangle's corners.
    pub(crate) normals: Vec<[[f32; 3]; 3]>,
    pub(crate) analytic: Vec<RayAnalytic>,
    /// Levels of nodes: the room that a search needs.
    pub(crate) depth: u32,
    /// What it took to fit the boxes to where the triangles have moved.
    pub(crate) refit_ms: Option<f64>,
}

/// Triangles and the number of the first body of their kind.
type Triangles<'a> = Vec<(&'a [Corner], u32)>;

/// A triangle: corners in local space, and its outward normal.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct RayTriangle {
    a_lc: Vec3,
    normal_x: f32,
    b_lc: Vec3,
    normal_y: f32,
    c_lc: Vec3,
    normal_z: f32,
}

/// Mirrors `RayAnalytic` in ray_analytic.wgsl.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct RayAnalytic {
    pub(crate) object_from_lc: Mat4,
    pub(crate) lc_from_object: Mat4,
    pub(crate) size_m: Vec4,
    pub(crate) formula: u32,
    pub(crate) body: u32,
}

struct Widened(Aabb);

impl Boundable for Widened {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl RayTree {
    /// Bodies and opaque surfaces.
    ///
    /// * `first`: the same in the first frame, if they move: the tree is that one's,
    ///   with boxes that fit now.
    /// * `reach_m`: how far from the local origin rays begin, at most.
    pub(crate) fn new(now: [&Drawables; 2], first: Option<[&Drawables; 2]>, reach_m: f64) -> Self {
        let mut tree = Self::default();
        let triangles = tree.collect(now);
        let of_first = first.map(|first| Self::default().collect(first));
        let same = |of_first: &Triangles<'_>| of_first.len() == triangles.len();
        tree.grow(&triangles, of_first.filter(same), reach_m);
        tree
    }

    /// Adds bodies without triangles; returns the triangles of the others.
    fn collect<'a>(&mut self, [bodies, opaque]: [&'a Drawables; 2]) -> Triangles<'a> {
        let mut corners: Triangles<'a> = Vec::new();
        for (drawables, first) in [(bodies, 0), (opaque, OPAQUE)] {
            for draw in &drawables.draws {
                match draw {
                    Draw::Triangles(range) => {
                        let range = range.start as usize..range.end as usize;
                        let triangles = drawables.corners[range].chunks_exact(3);
                        corners.extend(triangles.map(|triangle| (triangle, first)));
                    }
                    Draw::Analytic(formula, placed, size_m, number) => {
                        let lc_from_object =
                            DAffine3::from_translation(-drawables.centre) * *placed;
                        self.analytic.push(RayAnalytic {
                            object_from_lc: DMat4::from(lc_from_object.inverse()).as_mat4(),
                            lc_from_object: DMat4::from(lc_from_object).as_mat4(),
                            size_m: *size_m,
                            formula: *formula as u32,
                            body: first + number - 1,
                        });
                    }
                }
            }
        }
        corners
    }

    fn grow(&mut self, corners: &Triangles<'_>, first: Option<Triangles<'_>>, reach_m: f64) {
        if corners.is_empty() {
            return;
        }
        let all = corners.iter().chain(first.iter().flatten());
        let farthest = all.flat_map(|(triangle, _)| *triangle);
        let farthest =
            farthest.flat_map(|corner| corner.p_lc).fold(0.0, |a: f32, b| a.max(b.abs()));
        let wider = (WIDENED * (f64::from(farthest) + reach_m)) as f32;
        let boxes = |of: &Triangles<'_>| -> Vec<Widened> {
            of.iter().map(|(triangle, _)| Widened(bounds(triangle, wider))).collect()
        };
        let boxes_now = boxes(corners);
        let boxes = first.as_ref().map(boxes);
        let boxes = boxes.as_ref().unwrap_or(&boxes_now);
        let mut built =
            build_cwbvh(boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        self.depth = depth(&built);
        if first.is_some() {
            let started = Instant::now();
            let order = &built.primitive_indices;
            let now: Vec<Aabb> = order.iter().map(|i| boxes_now[*i as usize].0).collect();
            refit(&mut built.nodes, &now);
            self.refit_ms = Some(started.elapsed().as_secs_f64() * 1e3);
        }
        self.nodes = built.nodes;
        for index in built.primitive_indices {
            let (triangle, first) = corners[index as usize];
            let [normal_x, normal_y, normal_z] = triangle[0].geometric_ws;
            let [a_lc, b_lc, c_lc] = [0, 1, 2].map(|k| Vec3::from(triangle[k].p_lc));
            self.triangles.push(RayTriangle { a_lc, normal_x, b_lc, normal_y, c_lc, normal_z });
            self.bodies.push(first + triangle[0].body as u32 - 1);
            self.normals.push([0, 1, 2].map(|k| triangle[k].normal_ws));
        }
    }
}

fn bounds(triangle: &[Corner], wider: f32) -> Aabb {
    let mut bounds = Aabb::empty();
    for corner in triangle {
        bounds.extend(Vec3A::from(corner.p_lc));
    }
    Aabb::new(bounds.min - wider, bounds.max + wider)
}

/// Levels of nodes.
fn depth(tree: &CwBvh) -> u32 {
    let mut deepest = 0;
    let mut todo = vec![(0_u32, 1)];
    while let Some((index, level)) = todo.pop() {
        deepest = deepest.max(level);
        let node = &tree.nodes[index as usize];
        let children = node.imask.count_ones();
        todo.extend((0..children).map(|child| (node.child_base_idx + child, level + 1)));
    }
    deepest
}
