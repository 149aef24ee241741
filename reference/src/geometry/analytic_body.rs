//! A convex shape without triangles where it stands in the world.

use crate::geometry::chord;
use crate::geometry::line::{Line, ROUNDING};
use glam::{DAffine3, DMat3, DVec3};
use scenes::Shape;
use std::sync::Arc;

/// The shape, its place, and a ball around it.
#[derive(Clone, Debug)]
pub(crate) struct AnalyticBody {
    pub(crate) body: u32,
    /// Number of its entry; the exit has the next.
    pub(crate) id: u32,
    pub(crate) shape: Arc<Shape>,
    world_from_object: DAffine3,
    object_from_world: DAffine3,
    /// World normals from object normals, up to length.
    normal_from_object: DMat3,
    centre: DVec3,
    /// Infinite where the shape has no end.
    radius_m: f64,
}

impl AnalyticBody {
    pub(crate) fn new(body: u32, shape: &Arc<Shape>, world_from_object: DAffine3) -> Self {
        let object_from_world = world_from_object.inverse();
        let radius_m = match **shape {
            Shape::Sphere { radius_m } => radius_m,
            _ => shape.bounds().map(DVec3::length).into_iter().fold(0.0, f64::max),
        };
        Self {
            body,
            id: 0,
            shape: Arc::clone(shape),
            world_from_object,
            object_from_world,
            normal_from_object: object_from_world.matrix3.transpose(),
            centre: world_from_object.translation,
            radius_m: radius_m * stretch(world_from_object.matrix3),
        }
    }

    /// True of many lines that certainly miss the shape, whatever rounding does.
    #[inline(always)]
    pub(crate) fn is_passed_by(&self, line: &Line) -> bool {
        let to = line.origin - self.centre;
        let size = line.origin.abs().max_element() + self.centre.abs().max_element();
        let reach = self.radius_m + ROUNDING * (size + self.radius_m);
        to.cross(line.direction).length_squared() > reach * reach
    }

    /// Where a line enters and leaves, and the outward unit normals, in world
    /// space.
    pub(crate) fn chord(&self, line: &Line) -> Option<[(f64, DVec3, DVec3); 2]> {
        let origin = self.object_from_world.transform_point3(line.origin);
        let direction = self.object_from_world.transform_vector3(line.direction);
        let touches = chord::chord(&self.shape, origin, direction)?;
        Some(touches.map(|touch| {
            let point = self.world_from_object.transform_point3(touch.point);
            (touch.t, point, (self.normal_from_object * touch.normal).normalize())
        }))
    }
}

/// No vector gets longer than this many times its length. Exact where the
/// columns are perpendicular.
fn stretch(matrix: DMat3) -> f64 {
    let gram = matrix.transpose() * matrix;
    let rows = gram.transpose().to_cols_array_2d();
    let most = rows.map(|row| row.iter().map(|x| x.abs()).sum::<f64>());
    most.into_iter().fold(0.0, f64::max).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every line that has a chord is let through, also where it only grazes.
    #[test]
    fn no_line_that_meets_the_shape_passes_by() {
        let turned = DMat3::from_rotation_x(0.3) * DMat3::from_diagonal(DVec3::new(2.0, 0.5, 1.0));
        let shapes = [
            Shape::Sphere { radius_m: 0.7 },
            Shape::Box { half_extent_m: DVec3::new(0.1, 0.4, 0.2) },
            Shape::Cylinder { radius_m: 0.2, half_height_m: 0.6 },
            Shape::HalfSpace,
        ];
        let (mut met, mut passed) = (0, 0);
        for shape in shapes {
            let place = DAffine3 { matrix3: turned, translation: DVec3::new(3.0, -1.0, 0.2) };
            let body = AnalyticBody::new(0, &Arc::new(shape), place);
            for i in 0..20_000 {
                let turn = f64::from(i) * 0.618_033_988_749_895 * std::f64::consts::TAU;
                let z = 1.0 - f64::from(i) / 1e4;
                let r = (1.0 - z * z).max(0.0).sqrt();
                let direction = DVec3::new(r * turn.cos(), r * turn.sin(), z).normalize();
                let aside = direction.any_orthonormal_vector() * f64::from(i % 97) * 0.02;
                let line = Line::new(place.translation + aside - direction * 4.0, direction);
                let meets = body.chord(&line).is_some();
                assert!(!(meets && body.is_passed_by(&line)));
                met += u32::from(meets);
                passed += u32::from(body.is_passed_by(&line));
            }
        }
        assert!(met > 20_000 && passed > 10_000, "{met} {passed}");
    }

    /// A ball is passed by as soon as it is missed by more than rounding.
    #[test]
    fn a_ball_is_told_from_a_near_miss() {
        let place = DAffine3::from_scale(DVec3::splat(0.25));
        let body = AnalyticBody::new(0, &Arc::new(Shape::Sphere { radius_m: 2.0 }), place);
        let at = |y: f64| Line::new(DVec3::new(-3.0, y, 0.0), DVec3::X);
        assert!(!body.is_passed_by(&at(0.5)) && body.is_passed_by(&at(0.5 + 1e-12)));
    }
}
