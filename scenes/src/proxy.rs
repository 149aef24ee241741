//! Meshes that stand around analytic shapes, so that a rasteriser finds every
//! pixel that they may cover.

use crate::generate::{cuboid, geodesic, revolve};
use crate::{Mesh, Shape};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Room for rounding to f32 on the way to the GPU.
const MARGIN: f64 = 1.0 + 1e-6;
/// Sides of the prism around a cylinder.
const SIDES: u32 = 48;

impl Shape {
    /// A closed mesh that encloses the shape; a mesh is its own. Unbounded
    /// shapes are cut off at `reach_m` from the origin along each axis.
    #[must_use]
    pub fn proxy_mesh(&self, reach_m: f64) -> Mesh {
        match self {
            Self::Mesh(mesh) => mesh.clone(),
            Self::Sphere { radius_m } => around_ball(*radius_m),
            Self::Slab { thickness_m } => {
                cuboid(DVec3::new(reach_m, reach_m, 0.5 * thickness_m * MARGIN))
            }
            Self::HalfSpace => {
                let top = reach_m * (MARGIN - 1.0);
                cuboid(DVec3::splat(reach_m)).with_positions(|p| p.with_y(p.y.min(top)))
            }
            Self::Box { half_extent_m } => cuboid(*half_extent_m * MARGIN),
            Self::Cylinder { radius_m, half_height_m } => {
                let radius = radius_m * MARGIN / (PI / f64::from(SIDES)).cos();
                let height = half_height_m * MARGIN;
                let profile = [(0.0, -height), (radius, -height), (radius, height), (0.0, height)];
                revolve(&profile.map(DVec2::from), SIDES, false)
            }
        }
    }
}

/// A geodesic ball whose faces lie outside the given radius.
fn around_ball(radius_m: f64) -> Mesh {
    let ball = geodesic(8);
    let nearest_face = (0..ball.triangles.len())
        .map(|index| ball.area_vector(index).normalize().dot(ball.corners(index)[0]))
        .fold(1.0, f64::min);
    ball.with_positions(|p| p * (radius_m * MARGIN / nearest_face))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::SplitMix64;
    use crate::topology::solid;

    /// How far inside every face plane a point is (the proxies are convex).
    fn depth(mesh: &Mesh, point: DVec3) -> f64 {
        (0..mesh.triangles.len())
            .map(|i| mesh.area_vector(i).normalize().dot(mesh.corners(i)[0] - point))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn proxies_enclose_their_shapes_and_fit_them() {
        let shapes = [
            Shape::Sphere { radius_m: 0.7 },
            Shape::Box { half_extent_m: DVec3::new(0.2, 0.3, 0.4) },
            Shape::Cylinder { radius_m: 0.5, half_height_m: 0.6 },
            Shape::Slab { thickness_m: 0.2 },
            Shape::HalfSpace,
        ];
        let mut random = SplitMix64(1);
        for shape in shapes {
            let mesh = shape.proxy_mesh(2.0);
            assert_eq!(solid(&mesh), Ok(()), "{shape:?}");
            let mut least = f64::INFINITY;
            for _ in 0..2_000 {
                let p = DVec3::from_array([0; 3].map(|_| 2.0 * random.uniform() - 1.0));
                let on_surface = match &shape {
                    Shape::Sphere { radius_m } => p.normalize() * *radius_m,
                    Shape::Box { half_extent_m } => p * *half_extent_m,
                    Shape::Cylinder { radius_m, half_height_m } => {
                        let round = DVec2::new(p.x, p.z).normalize() * *radius_m;
                        DVec3::new(round.x, p.y * half_height_m, round.y)
                    }
                    Shape::Slab { thickness_m } => p.with_z(0.5 * thickness_m),
                    _ => p.with_y(0.0),
                };
                least = least.min(depth(&mesh, on_surface));
            }
            assert!(least > 0.0 && least < 0.02, "{shape:?}: {least}");
        }
    }
}
