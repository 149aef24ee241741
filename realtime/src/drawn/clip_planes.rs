//! Clip planes that follow what is looked at.
//!
//! Perspective depth is reversed: 1 at the near plane and 0 infinitely far away. A
//! float then keeps the same share of every distance, so that a far surface costs
//! a near one nothing (Lapidous & Jiao, "Optimal depth buffer for low-cost graphics
//! hardware", Graphics Hardware 1999). The near plane cuts alone, and it lies in
//! front of every surface.

use crate::drawn::drawables::{Draw, Drawables, Formula};
use glam::{DAffine3, DMat3, DMat4, DVec3, DVec4, Vec3, Vec4};
use rayon::prelude::*;
use scenes::distance::to_triangle_m;
use scenes::{Camera, Projection};

/// What rounding may add to a distance, and more.
const MARGIN: f64 = 1e-3;

/// Clip space from world space for a camera that looks at some drawables.
pub(crate) fn clip_from_world(camera: &Camera, drawn: &[&Drawables]) -> DMat4 {
    let half = camera.half_extent();
    let columns = match camera.projection {
        Projection::Perspective { .. } => {
            let near_m = near_m(camera.eye, half.x.hypot(half.y), drawn);
            [DVec4::NEG_W, DVec4::new(0.0, 0.0, near_m, 0.0)]
        }
        Projection::Orthographic { .. } => {
            let [near_m, far_m] = depths_m(camera, drawn);
            let depth_m = far_m - near_m;
            [DVec4::Z / depth_m, DVec4::new(0.0, 0.0, far_m / depth_m, 1.0)]
        }
    };
    let [z, w] = columns;
    let clip_from_view = DMat4::from_cols(DVec4::X / half.x, DVec4::Y / half.y, z, w);
    clip_from_view * camera.view_from_world()
}

/// Depth of a plane that no surface comes in front of, as far as it can be seen.
/// `reach`: tangent of the widest angle to the axis.
pub(crate) fn near_m(eye: DVec3, reach: f64, drawn: &[&Drawables]) -> f64 {
    let nearest_m = drawn.iter().map(|drawables| nearest_m(drawables, eye));
    let nearest_m = nearest_m.fold(f64::INFINITY, f64::min);
    // An eye in a surface sees it nowhere; nothing at all is seen anyhow.
    let least_m = f64::from(f32::MIN_POSITIVE).sqrt();
    let plane_m = (1.0 - MARGIN) * nearest_m / 1f64.hypot(reach);
    if plane_m.is_finite() { plane_m.max(least_m) } else { 1.0 }
}

/// Distance from a point (world space) to the nearest surface, metres, or less.
fn nearest_m(drawables: &Drawables, point: DVec3) -> f64 {
    let at = point - drawables.centre;
    let of = |draw: &Draw| match draw {
        Draw::Triangles(range) => {
            let corners = &drawables.corners[range.start as usize..range.end as usize];
            let position = |k: usize| DVec3::from(Vec3::from_array(corners[k].p_lc));
            let triangles = (0..corners.len() / 3).into_par_iter();
            let distances =
                triangles.map(|i| to_triangle_m([0, 1, 2].map(|k| position(3 * i + k)), at));
            distances.reduce(|| f64::INFINITY, f64::min)
        }
        Draw::Analytic(formula, placed, size_m, _) => {
            let inverse = placed.inverse();
            // What a length in the world comes to in the object, at most.
            let stretch = norm(inverse.matrix3);
            to_surface_m(*formula, *size_m, inverse.transform_point3(point)) / stretch
        }
    };
    drawables.draws.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// At least the largest factor by which a matrix lengthens.
fn norm(matrix: DMat3) -> f64 {
    matrix.to_cols_array().iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// Distance from a point (object space) to an analytic surface, or less.
fn to_surface_m(formula: Formula, size_m: Vec4, at: DVec3) -> f64 {
    let size_m = size_m.as_dvec4().truncate();
    let beyond = |q: DVec3| q.max(DVec3::ZERO).length() + q.max_element().min(0.0);
    let signed_m = match formula {
        Formula::Sphere => at.length() - size_m.x,
        Formula::Box => beyond(at.abs() - size_m),
        Formula::Cylinder => {
            let aside = DVec3::new(at.x, 0.0, at.z).length() - size_m.x;
            beyond(DVec3::new(aside, at.y.abs() - size_m.y, f64::NEG_INFINITY))
        }
        Formula::HalfSpace => at.y,
    };
    signed_m.abs()
}

/// Depths in front of the eye's plane that hold what is drawn.
fn depths_m(camera: &Camera, drawn: &[&Drawables]) -> [f64; 2] {
    let forward = camera.basis().forward;
    let (mut low, mut high) = (f64::INFINITY, 0f64);
    let mut hold = |depth_m: f64| {
        if depth_m.is_finite() {
            (low, high) = (low.min(depth_m), high.max(depth_m));
        }
    };
    for drawables in drawn {
        let origin_m = (drawables.centre - camera.eye).dot(forward);
        for corner in &drawables.corners {
            let p_lc = DVec3::from(Vec3::from_array(corner.p_lc));
            hold(origin_m + p_lc.dot(forward));
        }
        for draw in &drawables.draws {
            let Draw::Analytic(formula, placed, size_m, _) = draw else { continue };
            column_depths_m(camera, bounds(*formula, *size_m), placed)
                .into_iter()
                .for_each(&mut hold);
        }
    }
    let low = low.clamp(0.0, high);
    let room_m = MARGIN * (high - low).max(f64::from(f32::EPSILON) * high);
    [(low - room_m).max(0.0), high + room_m.max(f64::from(f32::MIN_POSITIVE))]
}

/// Bounds of an analytic surface in its own space, infinite where it has none.
fn bounds(formula: Formula, size_m: Vec4) -> [DVec3; 2] {
    let size_m = size_m.as_dvec4();
    let half = match formula {
        Formula::Cylinder => DVec3::new(size_m.x, size_m.y, size_m.x),
        Formula::HalfSpace => return [DVec3::NEG_INFINITY, DVec3::INFINITY.with_y(0.0)],
        Formula::Sphere | Formula::Box => size_m.truncate(),
    };
    [-half, half]
}

/// Depths between which parallel rays are in a box, or more. A side is met at a
/// depth that is linear over the image, so its extremes are at the image's corners.
fn column_depths_m(camera: &Camera, [low, high]: [DVec3; 2], placed: &DAffine3) -> [f64; 2] {
    let (basis, half, inverse) = (camera.basis(), camera.half_extent(), placed.inverse());
    let d = inverse.transform_vector3(basis.forward);
    let [mut near_m, mut far_m] = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    for [x, y] in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
        let aside = x * half.x * basis.right + y * half.y * basis.up;
        let o = inverse.transform_point3(camera.eye + aside);
        let (a, b) = ((low - o) / d, (high - o) / d);
        (near_m, far_m) = (near_m.min(a.min(b)), far_m.max(a.max(b)));
    }
    let along = d.abs().cmpgt(DVec3::splat(1e-12 * d.length()));
    let near_m = DVec3::select(along, near_m, DVec3::NEG_INFINITY).max_element();
    [near_m, DVec3::select(along, far_m, DVec3::INFINITY).min_element()]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;
    use crate::drawn::drawables::PlacedShape;
    use scenes::Shape;
    use scenes::scene::Normals;

    fn drawn(shape: &Shape, world_from_object: DAffine3) -> Drawables {
        let mut drawables = Drawables::new(DVec3::new(0.1, 0.2, 0.3));
        let normals = Normals::Flat;
        drawables.add(&PlacedShape { shape, world_from_object, normals, number: 1 }, 1e4);
        drawables
    }

    /// Inside and outside, with a closed form, and never more than the distance
    /// where a placement stretches.
    #[test]
    fn surfaces_are_as_far_as_they_are() {
        let (ball, rod) = (
            Shape::Sphere { radius_m: 2.0 },
            Shape::Cylinder { radius_m: 1.0, half_height_m: 3.0 },
        );
        let cube = Shape::Box { half_extent_m: DVec3::new(1.0, 2.0, 3.0) };
        let mesh = Shape::Mesh(scenes::generate::builtin("geodesic-16").unwrap());
        let at = DVec3::new;
        for (shape, point, expected) in [
            (&ball, at(0.0, 0.0, 5.0), 3.0),
            (&ball, at(0.0, 0.5, 0.0), 1.5),
            (&rod, at(3.0, 0.0, 4.0), 4.0),
            (&rod, at(0.0, 2.5, 0.0), 0.5),
            (&rod, at(2.0, 4.0, 0.0), 2f64.sqrt()),
            (&cube, at(1.0, 3.0, 4.0), 2f64.sqrt()),
            (&cube, at(0.9, 0.0, 0.0), 0.1),
            (&Shape::HalfSpace, at(7.0, -0.25, 1.0), 0.25),
        ] {
            let found = nearest_m(&drawn(shape, DAffine3::IDENTITY), point);
            assert!((found - expected / 3f64.sqrt()).abs() < 1e-6, "{shape:?} {point}: {found}");
        }
        let found = nearest_m(&drawn(&mesh, DAffine3::IDENTITY), at(0.0, 0.0, 3.0));
        assert!((2.0..2.02).contains(&found), "{found}");
        let flat = DAffine3::from_scale(at(1.0, 0.01, 1.0));
        assert!(nearest_m(&drawn(&ball, flat), at(0.0, 0.03, 0.0)) <= 0.01);
    }

    /// The plane lies between the eye and every point that is seen.
    #[test]
    fn reversed_depth_has_its_one_in_front_of_all() {
        let ball = drawn(&Shape::Sphere { radius_m: 1.0 }, DAffine3::IDENTITY);
        let floor = Shape::Box { half_extent_m: DVec3::new(1e7, 0.5, 1e7) };
        let floor = drawn(&floor, DAffine3::from_translation(DVec3::new(0.0, -2.0, 0.0)));
        let projections = [
            Projection::Perspective { vertical_fov_deg: 60.0 },
            Projection::Orthographic { height_m: 3.0 },
        ];
        for projection in projections {
            let eye = DVec3::new(0.0, 0.0, 4.0);
            let (target, up, resolution_px) = (DVec3::ZERO, DVec3::Y, [64; 2]);
            let camera = Camera { eye, target, up, projection, resolution_px };
            let clip = clip_from_world(&camera, &[&ball, &floor]);
            let depth = |z: f64| clip.project_point3(DVec3::new(0.0, 0.0, z)).z;
            let (near, far, behind) = (depth(1.0), depth(-1.0), depth(-1e6));
            assert!(near <= 1.0 && near > far && far > behind && behind > 0.0, "{projection:?}");
        }
    }
}
