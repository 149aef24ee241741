//! Bodies of revolution about the y axis, and their profiles.

use super::grid::index;
use crate::Mesh;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Turns a profile of points (distance from the axis, height), metres, about
/// the y axis in `slices` steps.
///
/// The profile runs with the solid on its left: up along an outer wall. Points
/// on the axis (distance exactly 0) become one vertex. The body is closed if
/// the profile starts and ends on the axis, or at one point (then pass it once
/// and `closed = true`).
#[must_use]
pub fn revolve(profile: &[DVec2], slices: u32, closed: bool) -> Mesh {
    let mut mesh = Mesh::default();
    let rings: Vec<Ring> = profile.iter().map(|p| Ring::new(&mut mesh, *p, slices)).collect();
    let count = if closed { rings.len() } else { rings.len().saturating_sub(1) };
    for i in 0..count {
        let (below, above) = (&rings[i], &rings[(i + 1) % rings.len()]);
        for slice in 0..slices {
            let next = (slice + 1) % slices;
            let [a, b] = [below.at(slice), below.at(next)];
            let [d, c] = [above.at(slice), above.at(next)];
            if c != d {
                mesh.triangles.push([a, d, c]);
            }
            if a != b {
                mesh.triangles.push([a, c, b]);
            }
        }
    }
    mesh
}

/// Vertices of one profile point.
struct Ring {
    first: u32,
    is_pole: bool,
}

impl Ring {
    fn new(mesh: &mut Mesh, point: DVec2, slices: u32) -> Self {
        let first = index(mesh.positions.len());
        let is_pole = point.x == 0.0;
        let count = if is_pole { 1 } else { slices };
        mesh.positions.extend((0..count).map(|slice| {
            let (sin, cos) = (TAU * f64::from(slice) / f64::from(slices)).sin_cos();
            DVec3::new(point.x * cos, point.y, point.x * sin)
        }));
        Self { first, is_pole }
    }

    fn at(&self, slice: u32) -> u32 {
        if self.is_pole { self.first } else { self.first + slice }
    }
}

/// Half circle of unit radius from the lower pole to the upper, in `stacks`
/// equal angles.
fn half_circle(stacks: u32) -> Vec<DVec2> {
    (0..=stacks)
        .map(|stack| match stack {
            0 => DVec2::new(0.0, -1.0),
            s if s == stacks => DVec2::new(0.0, 1.0),
            s => {
                let (sin, cos) = (PI * f64::from(s) / f64::from(stacks)).sin_cos();
                DVec2::new(sin, -cos)
            }
        })
        .collect()
}

/// Ball of unit radius with vertices on meridians and parallels:
/// 2 · slices · (stacks - 1) triangles.
#[must_use]
pub fn uv_sphere(slices: u32, stacks: u32) -> Mesh {
    revolve(&half_circle(stacks), slices, false)
}

/// The half of the unit ball with y ≥ 0, flat side down.
#[must_use]
pub fn half_ball(slices: u32, stacks: u32) -> Mesh {
    let mut profile = vec![DVec2::ZERO];
    profile.extend((0..=stacks).map(|stack| {
        if stack == stacks {
            return DVec2::Y;
        }
        let (sin, cos) = (0.5 * PI * f64::from(stack) / f64::from(stacks)).sin_cos();
        DVec2::new(cos, sin)
    }));
    revolve(&profile, slices, false)
}

/// Biconvex lens of unit rim radius, axis along y, with surfaces of radius
/// `curvature_m` ≥ 1 that meet in a sharp rim.
#[must_use]
pub fn lens(curvature_m: f64, slices: u32, stacks: u32) -> Mesh {
    let half_angle = (1.0 / curvature_m.max(1.0)).asin();
    let centre = curvature_m.max(1.0) * half_angle.cos();
    let arc = |step: u32| {
        let (sin, cos) = (half_angle * f64::from(step) / f64::from(stacks)).sin_cos();
        DVec2::new(curvature_m.max(1.0) * sin, centre - curvature_m.max(1.0) * cos)
    };
    let mut profile: Vec<DVec2> = (0..stacks).map(arc).collect();
    profile.push(DVec2::X);
    profile.extend((0..stacks).rev().map(|step| arc(step) * DVec2::new(1.0, -1.0)));
    revolve(&profile, slices, false)
}

/// Torus about the y axis: distance of the tube's centre from the axis, and the
/// tube's own radius, metres. 2 · slices · sides triangles.
#[must_use]
pub fn torus(ring_m: f64, tube_m: f64, slices: u32, sides: u32) -> Mesh {
    let profile: Vec<DVec2> = (0..sides)
        .map(|side| {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
            DVec2::new(ring_m + tube_m * cos, tube_m * sin)
        })
        .collect();
    revolve(&profile, slices, true)
}

/// Points along a polyline whose corners are rounded: each inner corner is
/// replaced by a quadratic curve that starts and ends its number of metres away.
/// `count` points, both ends included, closer together where the curve turns.
pub(super) fn rounded(corners: &[(DVec2, f64)], count: u32) -> Vec<DVec2> {
    let mut dense = vec![corners[0].0];
    for window in corners.windows(3) {
        let [(before, _), (corner, reach_m), (after, _)] = [window[0], window[1], window[2]];
        let from = corner + (before - corner).normalize() * reach_m;
        let to = corner + (after - corner).normalize() * reach_m;
        dense.extend((0..=64).map(|step| {
            let t = f64::from(step) / 64.0;
            from.lerp(corner, t).lerp(corner.lerp(to, t), t)
        }));
    }
    dense.extend(corners.last().map(|(end, _)| *end));
    resampled(&dense, count)
}

/// Length that a turn of one radian counts for when points are spread, metres.
const TURN_M: f64 = 0.06;

fn resampled(points: &[DVec2], count: u32) -> Vec<DVec2> {
    let mut measure = vec![0.0];
    for i in 1..points.len() {
        let step = points[i] - points[i - 1];
        let turn = points.get(i + 1).map_or(0.0, |next| step.angle_to(next - points[i]).abs());
        // A step without length has no direction.
        let turn = if turn.is_finite() { turn } else { 0.0 };
        measure.push(measure[i - 1] + step.length() + TURN_M * turn);
    }
    let (last, total) = (points.len() - 1, measure[measure.len() - 1]);
    (0..count)
        .map(|i| {
            if i == 0 || i + 1 == count {
                return points[if i == 0 { 0 } else { last }];
            }
            let target = total * f64::from(i) / f64::from(count - 1);
            let after = measure.partition_point(|m| *m < target).clamp(1, last);
            let span = measure[after] - measure[after - 1];
            let share = if span > 0.0 { (target - measure[after - 1]) / span } else { 0.0 };
            points[after - 1].lerp(points[after], share)
        })
        .collect()
}

/// A drinking cup, 1 m tall: a tapered wall around an empty inside, all edges
/// rounded, standing on y = 0. 50 slices around, 71 rings and two poles: 7,100
/// triangles.
#[must_use]
pub fn cup() -> Mesh {
    let at = DVec2::new;
    let corners = [
        (at(0.0, 0.0), 0.0),
        (at(0.36, 0.0), 0.08),
        (at(0.50, 1.0), 0.0395),
        (at(0.42, 1.0), 0.0395),
        (at(0.30, 0.10), 0.08),
        (at(0.0, 0.10), 0.0),
    ];
    revolve(&rounded(&corners, 73), 50, false)
}
