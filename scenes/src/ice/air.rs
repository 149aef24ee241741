//! Air in a body: textured planes for the image-space method, and bubbles for
//! the exact one.

use crate::Shape;
use crate::distance::{to_triangle_m, winding};
use crate::ice::pose::{centre_and_diagonal, offset, placed, rotation};
use crate::noise::SplitMix64;
use crate::scene::Air;
use glam::{DAffine3, DVec3};
use rayon::prelude::*;

/// A spherical bubble in the body's space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bubble {
    /// Metres.
    pub centre_m: DVec3,
    /// Metres.
    pub radius_m: f64,
}

/// Body space from the space of the unit square |x|, |y| ≤ 0.5 for each plane:
/// through the centre of the bounding box, uniformly turned, 0.8 of the box's
/// diagonal wide.
#[must_use]
pub fn air_planes(air: &Air, bounds: [DVec3; 2]) -> Vec<DAffine3> {
    let (centre, diagonal) = centre_and_diagonal(bounds);
    let mut random = SplitMix64(air.seed);
    (0..air.planes).map(|_| placed(0.8 * diagonal, rotation(&mut random), centre)).collect()
}

/// Bubbles wholly inside a bounded shape and apart from each other, denser
/// towards the centre. Where the shape leaves no room there are fewer than
/// asked for.
#[must_use]
pub fn bubbles(air: &Air, shape: &Shape) -> Vec<Bubble> {
    let (centre, diagonal) = centre_and_diagonal(shape.bounds());
    let radius_m = air.bubble_radius * diagonal;
    let mut random = SplitMix64(air.seed ^ 0x0b0b_b1e5);
    let mut bubbles: Vec<Bubble> = Vec::new();
    if !diagonal.is_finite() || radius_m <= 0.0 {
        return bubbles;
    }
    for _ in 0..air.bubbles {
        let place = (0..32).find_map(|_| {
            let at = centre + offset(&mut random, 0.12 * diagonal, 0.5 * diagonal);
            let is_apart = bubbles.iter().all(|b| b.centre_m.distance(at) > 2.05 * radius_m);
            (is_apart && clearance_m(shape, at) > 1.05 * radius_m).then_some(at)
        });
        bubbles.extend(place.map(|centre_m| Bubble { centre_m, radius_m }));
    }
    bubbles
}

/// Distance from a point inside a shape to its surface, metres; not positive
/// outside.
fn clearance_m(shape: &Shape, p: DVec3) -> f64 {
    match shape {
        Shape::Mesh(mesh) if winding(mesh, p) < 0.5 => 0.0,
        Shape::Mesh(mesh) => (0..mesh.triangles.len())
            .into_par_iter()
            .map(|index| to_triangle_m(mesh.corners(index), p))
            .reduce(|| f64::INFINITY, f64::min),
        Shape::Sphere { radius_m } => radius_m - p.length(),
        Shape::Slab { thickness_m } => 0.5 * thickness_m - p.z.abs(),
        Shape::HalfSpace => -p.y,
        Shape::Box { half_extent_m } => (*half_extent_m - p.abs()).min_element(),
        Shape::Cylinder { radius_m, half_height_m } => {
            (radius_m - p.x.hypot(p.z)).min(half_height_m - p.y.abs())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{cuboid, shell};

    const AIR: Air = Air { planes: 19, bubbles: 40, bubble_radius: 0.02, seed: 4 };

    #[test]
    fn a_mesh_and_the_shape_it_shows_have_the_same_clearance() {
        let half_extent_m = DVec3::new(0.4, 0.7, 1.0);
        let mesh = Shape::Mesh(cuboid(half_extent_m));
        let exact = Shape::Box { half_extent_m };
        let mut random = crate::noise::SplitMix64(2);
        for _ in 0..500 {
            let p = DVec3::from_array([0; 3].map(|_| 2.0 * random.uniform() - 1.0));
            let (found, expected) = (clearance_m(&mesh, p), clearance_m(&exact, p));
            assert!((found - expected.max(0.0)).abs() < 1e-14, "{p}: {found} {expected}");
        }
    }

    #[test]
    fn planes_go_through_the_centre_and_differ() {
        let bounds = [DVec3::ZERO, DVec3::splat(2.0)];
        let planes = air_planes(&AIR, bounds);
        assert_eq!(planes.len(), 19);
        for plane in &planes {
            assert!(plane.transform_point3(DVec3::ZERO).distance(DVec3::ONE) < 1e-15);
            let side = plane.transform_vector3(DVec3::X).length();
            assert!((side - 0.8 * 12.0f64.sqrt()).abs() < 1e-14);
        }
        assert_ne!(planes[0], planes[1]);
        assert_eq!(planes, air_planes(&AIR, bounds));
    }

    #[test]
    fn bubbles_are_inside_and_apart() {
        let ball = Shape::Sphere { radius_m: 1.0 };
        let found = bubbles(&AIR, &ball);
        assert_eq!(found.len(), 40);
        for (i, one) in found.iter().enumerate() {
            assert!(one.centre_m.length() + one.radius_m < 1.0);
            for other in &found[..i] {
                assert!(one.centre_m.distance(other.centre_m) > 2.0 * one.radius_m);
            }
        }
        assert_eq!(found, bubbles(&AIR, &ball));
    }

    /// In a hollow ball none is in the hollow; where there is no room, none at all.
    #[test]
    fn bubbles_stay_in_the_material() {
        let hollow = Shape::Mesh(shell(16, 0.5));
        let found = bubbles(&AIR, &hollow);
        assert!(!found.is_empty());
        assert!(found.iter().all(|b| b.centre_m.length() - b.radius_m > 0.5));
        let pane = Shape::Mesh(cuboid(DVec3::new(1.0, 1.0, 1e-3)));
        assert_eq!(bubbles(&AIR, &pane), []);
        assert_eq!(bubbles(&AIR, &Shape::HalfSpace), []);
    }
}
