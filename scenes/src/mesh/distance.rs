//! Where a point is relative to a mesh: how far from its triangles, and how often
//! it is inside.

use crate::Mesh;
use glam::DVec3;

/// How often a mesh winds around a point: the sum of its triangles' solid angles
/// over 4π. A whole number off a closed surface, within rounding.
///
/// Source: Van Oosterom & Strackee, "The solid angle of a plane triangle", IEEE
/// Transactions on Biomedical Engineering 30 (2), 1983.
#[must_use]
pub fn winding(mesh: &Mesh, point: DVec3) -> f64 {
    let triangles = 0..mesh.triangles.len();
    let sum: f64 = triangles.map(|index| solid_angle(mesh.corners(index), point)).sum();
    sum / (4.0 * std::f64::consts::PI)
}

/// Solid angle of a triangle seen from a point, steradians, positive seen from
/// behind. Source: as [`winding`].
pub(crate) fn solid_angle(corners: [DVec3; 3], point: DVec3) -> f64 {
    let [a, b, c] = corners.map(|p| (p - point).normalize_or_zero());
    2.0 * a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// Distance from a point to a triangle, metres.
#[must_use]
pub fn to_triangle_m([a, b, c]: [DVec3; 3], p: DVec3) -> f64 {
    let normal = (b - a).cross(c - a);
    let is_above_inside = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|(from, to)| normal.cross(*to - *from).dot(p - *from) >= 0.0);
    if is_above_inside && normal != DVec3::ZERO {
        return (p - a).dot(normal).abs() / normal.length();
    }
    [(a, b), (b, c), (c, a)]
        .iter()
        .map(|(a, b)| to_segment_m(*a, *b, p))
        .fold(f64::INFINITY, f64::min)
}

fn to_segment_m(a: DVec3, b: DVec3, p: DVec3) -> f64 {
    let along = b - a;
    let length_squared = along.length_squared();
    let share = if length_squared > 0.0 { (p - a).dot(along) / length_squared } else { 0.0 };
    p.distance(a + along * share.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{shell, teapot};

    #[test]
    fn distances_to_faces_edges_and_corners() {
        let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for (point, distance) in [
            (DVec3::new(0.2, 0.2, -3.0), 3.0),
            (DVec3::new(0.5, -2.0, 0.0), 2.0),
            (DVec3::new(4.0, 0.0, 4.0), 5.0),
            (DVec3::ONE.with_z(0.0), 0.5f64.sqrt()),
        ] {
            assert!((to_triangle_m(triangle, point) - distance).abs() < 1e-15, "{point}");
        }
    }

    /// Overlapping solids count twice, cavities not at all.
    #[test]
    fn windings_count_solids() {
        let hollow = shell(8, 0.5);
        for (x, count) in [(0.0, 0.0), (0.75, 1.0), (1.5, 0.0)] {
            assert!((winding(&hollow, DVec3::new(x, 0.01, 0.0)) - count).abs() < 1e-12);
        }
        // Where the handle starts it is inside the body.
        let pot = teapot(15);
        let in_both = DVec3::new(-1.56 / 3.0, 2.13 / 3.0, 0.0);
        assert!((winding(&pot, in_both) - 2.0).abs() < 1e-12);
        assert!((winding(&pot, DVec3::new(0.0, 0.3, 0.0)) - 1.0).abs() < 1e-12);
    }
}
