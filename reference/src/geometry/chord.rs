//! Convex shapes without tessellation: where a line enters and leaves them.

use glam::DVec3;
use scenes::Shape;

/// A point where a line passes the surface of a convex shape, object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch {
    /// In multiples of the line's direction; infinite where the shape has no end.
    pub(crate) t: f64,
    /// On the surface.
    pub(crate) point: DVec3,
    /// Outward, not necessarily unit.
    pub(crate) normal: DVec3,
}

/// The stretch of a line inside a convex shape: entry, then exit. `None` when
/// the line misses, touches in a point only, or the shape is a mesh.
///
/// * `origin`, `direction`: in the shape's space; any length but zero.
pub(crate) fn chord(shape: &Shape, origin: DVec3, direction: DVec3) -> Option<[Touch; 2]> {
    match *shape {
        Shape::Mesh(_) => None,
        Shape::Sphere { radius_m } => round(origin, direction, DVec3::ONE, radius_m),
        Shape::Slab { thickness_m } => {
            between(origin, direction, DVec3::Z, -0.5 * thickness_m, 0.5 * thickness_m)
        }
        Shape::HalfSpace => between(origin, direction, DVec3::Y, f64::NEG_INFINITY, 0.0),
        Shape::Box { half_extent_m: half } => {
            let side = |axis: DVec3, h: f64| between(origin, direction, axis, -h, h);
            let x = side(DVec3::X, half.x)?;
            let y = side(DVec3::Y, half.y)?;
            overlap(overlap(x, y)?, side(DVec3::Z, half.z)?)
        }
        Shape::Cylinder { radius_m, half_height_m: half } => overlap(
            round(origin, direction, DVec3::new(1.0, 0.0, 1.0), radius_m)?,
            between(origin, direction, DVec3::Y, -half, half)?,
        ),
    }
}

/// Sphere, or cylinder without ends when `mask` drops an axis.
fn round(origin: DVec3, direction: DVec3, mask: DVec3, radius: f64) -> Option<[Touch; 2]> {
    let (o, d) = (origin * mask, direction * mask);
    let d2 = d.length_squared();
    if d2 == 0.0 {
        return (o.length_squared() < radius * radius).then(|| everywhere(o));
    }
    // From the point nearest the centre: no cancellation for distant origins.
    let middle = -o.dot(d) / d2;
    let nearest = o + d * middle;
    let half2 = (radius - nearest.length()) * (radius + nearest.length()) / d2;
    if half2 <= 0.0 || half2.is_nan() {
        return None;
    }
    let half = half2.sqrt();
    let touch = |side: f64| {
        let t = middle + side * half;
        let normal = nearest + d * (side * half);
        // Along the masked axes the point is on the surface to the last bit or two.
        let on = normal * (radius / normal.length());
        Touch { t, point: on + (origin + direction * t) * (DVec3::ONE - mask), normal }
    };
    Some([touch(-1.0), touch(1.0)])
}

/// Between two planes perpendicular to a coordinate axis.
fn between(
    origin: DVec3,
    direction: DVec3,
    axis: DVec3,
    low: f64,
    high: f64,
) -> Option<[Touch; 2]> {
    let (o, d) = (origin.dot(axis), direction.dot(axis));
    if d == 0.0 {
        return (low < o && o < high).then(|| everywhere(axis));
    }
    let touch = |plane: f64, normal: DVec3| {
        let t = (plane - o) / d;
        let along = origin + direction * t;
        let on = if plane.is_finite() { axis * plane } else { axis * along.dot(axis) };
        Touch { t, point: along * (DVec3::ONE - axis) + on, normal }
    };
    let (below, above) = (touch(low, -axis), touch(high, axis));
    Some(if d > 0.0 { [below, above] } else { [above, below] })
}

fn everywhere(normal: DVec3) -> [Touch; 2] {
    [f64::NEG_INFINITY, f64::INFINITY].map(|t| Touch { t, point: DVec3::splat(t), normal })
}

/// The stretch inside both.
fn overlap(a: [Touch; 2], b: [Touch; 2]) -> Option<[Touch; 2]> {
    let enter = if b[0].t > a[0].t { b[0] } else { a[0] };
    let leave = if b[1].t < a[1].t { b[1] } else { a[1] };
    (enter.t < leave.t).then_some([enter, leave])
}
