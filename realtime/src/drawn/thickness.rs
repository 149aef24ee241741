//! d_N: how far it is from a vertex along its inward normal to the other side
//! of the body. Wyman, "An approximate image-space approach for interactive
//! refraction", SIGGRAPH 2005. One ray per vertex, whenever the mesh changes.

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ray::{Ray, RayHit};
use obvhs::{Boundable, BvhBuildParams};
use rayon::prelude::*;
use std::time::Duration;

struct Padded(Aabb);

impl Boundable for Padded {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// Distances in metres, one per corner of each triangle; 0 where the ray meets
/// nothing, which only an open mesh allows.
///
/// * `points`: the triangles' corners, metres.
/// * `vertices`: their vertex numbers; a ray skips the triangles that share the
///   vertex it starts from.
/// * `inward`: unit directions, one per corner.
pub(crate) fn along_normals(
    points: &[[DVec3; 3]],
    vertices: &[[u32; 3]],
    inward: &[[DVec3; 3]],
) -> Vec<[f64; 3]> {
    let low = points.iter().flatten().fold(DVec3::INFINITY, |a, b| a.min(*b));
    let high = points.iter().flatten().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b));
    // Boxes of zero thickness and rays in f32: a margin of a few f32 steps.
    let pad = 4.0 * f32::EPSILON * low.abs().max(high.abs()).max_element() as f32;
    let boxes: Vec<Padded> = points
        .iter()
        .map(|corners| {
            let mut bounds = Aabb::empty();
            for corner in corners {
                bounds.extend(Vec3A::from(corner.as_vec3()));
            }
            Padded(Aabb::new(bounds.min - pad, bounds.max + pad))
        })
        .collect();
    let tree = build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut Duration::default());
    let distance = |vertex: u32, from: DVec3, d: DVec3| {
        let mut nearest = f64::INFINITY;
        let ray = Ray::new_inf(Vec3A::from(from.as_vec3()), Vec3A::from(d.as_vec3()));
        tree.ray_traverse(ray, &mut RayHit::none(), |_, slot| {
            let triangle = tree.primitive_indices[slot] as usize;
            if !vertices[triangle].contains(&vertex)
                && let Some(t) = intersect(&points[triangle], from, d)
            {
                nearest = nearest.min(t);
            }
            // Rounded up: an f32 below the true distance would prune its box.
            if nearest.is_finite() { (nearest * (1.0 + 1e-6)) as f32 } else { f32::INFINITY }
        });
        if nearest.is_finite() { nearest } else { 0.0 }
    };
    let corners = points.par_iter().zip(vertices).zip(inward);
    corners.map(|((p, v), d)| [0, 1, 2].map(|k| distance(v[k], p[k], d[k]))).collect()
}

/// Möller & Trumbore, edges included with a margin of 1e-9: rays from a corner
/// often end exactly at the opposite edge.
fn intersect(corners: &[DVec3; 3], origin: DVec3, d: DVec3) -> Option<f64> {
    let (e1, e2) = (corners[1] - corners[0], corners[2] - corners[0]);
    let p = d.cross(e2);
    let det = e1.dot(p);
    let s = origin - corners[0];
    let u = s.dot(p) / det;
    let q = s.cross(e1);
    let v = d.dot(q) / det;
    let t = e2.dot(q) / det;
    let margin = 1e-9;
    (u >= -margin && v >= -margin && u + v <= 1.0 + margin && t > 0.0).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> (Vec<[DVec3; 3]>, Vec<[u32; 3]>) {
        let corner =
            |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1));
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let vertices: Vec<[u32; 3]> =
            faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect();
        (vertices.iter().map(|t| t.map(corner)).collect(), vertices)
    }

    /// Every corner sees the opposite face at the edge's length along its own
    /// face's normal, although the ray runs along two other faces.
    #[test]
    fn a_cube_is_as_thick_as_its_edge_and_half_a_cube_is_open() {
        let (points, vertices) = cube();
        let inward: Vec<_> =
            points.iter().map(|p| [(p[2] - p[0]).cross(p[1] - p[0]).normalize(); 3]).collect();
        let found = along_normals(&points, &vertices, &inward);
        assert!(found.iter().flatten().all(|d| (d - 1.0).abs() < 1e-9), "{found:?}");
        let open = along_normals(&points[..2], &vertices[..2], &inward[..2]);
        assert!(open.iter().flatten().all(|d| *d == 0.0), "{open:?}");
    }
}
