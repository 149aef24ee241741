//! Whether a closed mesh is convex, beyond doubt.

use super::{edges, inspect};
use crate::{Mesh, distance::winding};
use glam::{DVec3, Vec3Swizzles};

/// True only if the mesh certainly bounds one convex body.
///
/// A closed connected manifold of Euler characteristic 2 is convex if it winds
/// once around an interior point that lies strictly behind every triangle
/// (then it is the graph of a radius over directions and cannot meet itself)
/// and no edge is concave (Tietze's theorem: local convexity is enough). Edge
/// signs count only beyond their rounding error, so nearly flat edges of rotated
/// boxes give `false`: the answer errs on the side that costs time.
#[must_use]
pub fn is_convex(mesh: &Mesh) -> bool {
    let report = inspect(mesh);
    if !report.is_manifold() || report.components != 1 || report.euler_characteristic != 2 {
        return false;
    }
    let centre = mesh.positions.iter().sum::<DVec3>() / mesh.positions.len() as f64;
    let is_behind_all =
        (0..mesh.triangles.len()).all(|index| sign_above(mesh.corners(index), centre) == Some(-1));
    is_behind_all && (winding(mesh, centre) - 1.0).abs() < 0.5 && has_no_concave_edge(mesh)
}

fn has_no_concave_edge(mesh: &Mesh) -> bool {
    let sides = edges::sides(mesh);
    edges::edges(&sides).all(|edge| {
        let [one, two] = edge else { return false };
        let opposite = mesh.triangles[two.triangle()][(two.corner as usize + 2) % 3];
        let above = sign_above(mesh.corners(one.triangle()), mesh.positions[opposite as usize]);
        above.is_some_and(|sign| sign <= 0)
    })
}

/// Side of a point relative to a triangle's plane: 1 above (outside), -1 below,
/// 0 exactly on it; `None` where rounding hides the answer.
fn sign_above([a, b, c]: [DVec3; 3], p: DVec3) -> Option<i32> {
    let [u, v, w] = [b - a, c - a, p - a];
    let determinant = u.cross(v).dot(w);
    let bound = (u.abs().yzx() * v.abs().zxy() + u.abs().zxy() * v.abs().yzx()).dot(w.abs());
    // Eight roundings of at most 2^-53 each, the differences included.
    let error = 16.0 * f64::EPSILON * bound;
    if determinant.abs() > error || error == 0.0 {
        return Some(if determinant == 0.0 { 0 } else { determinant.signum() as i32 });
    }
    None
}
