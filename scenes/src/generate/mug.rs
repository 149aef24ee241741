//! A mug with a handle: one closed surface of genus 1.

use super::grid::index;
use super::revolve::{revolve, rounded};
use crate::{Mesh, topology::weld};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

const SLICES: u32 = 41;
/// Segments of the profile; 41 rings lie between the two poles.
const STACKS: u32 = 42;
/// Middle profile point of the upper and the lower hole for the handle.
const HOLES: [u32; 2] = [17, 10];
/// Rings of quads along the handle.
const SEGMENTS: u32 = 14;

/// A mug, 1 m tall, handle towards +x, standing on y = 0.
///
/// The wall has 41 slices, 41 rings and two poles. Two holes of 4 x 4 quads in
/// its outer side are joined by a tube of 16 x 14 quads that uses their
/// boundary vertices. 3,746 triangles, Euler characteristic 0.
#[must_use]
pub fn mug() -> Mesh {
    let at = DVec2::new;
    let corners = [
        (at(0.0, 0.0), 0.0),
        (at(0.40, 0.0), 0.06),
        (at(0.40, 1.0), 0.0345),
        (at(0.33, 1.0), 0.0345),
        (at(0.33, 0.09), 0.07),
        (at(0.0, 0.09), 0.0),
    ];
    let mut mesh = revolve(&rounded(&corners, STACKS + 1), SLICES, false);
    let rims = HOLES.map(|middle| rim(middle, middle == HOLES[1]));
    mesh.triangles.retain(|triangle| {
        !HOLES.iter().any(|middle| triangle.iter().all(|v| is_in_hole(*v, *middle)))
    });
    add_handle(&mut mesh, rims);
    weld(&mesh)
}

/// Vertex on a profile point, `column` slices from the handle's plane.
fn wall_vertex(point: u32, column: i32) -> u32 {
    1 + (point - 1) * SLICES + column.rem_euclid(SLICES.cast_signed()).cast_unsigned()
}

fn is_in_hole(vertex: u32, middle: u32) -> bool {
    (middle - 2..=middle + 2).any(|point| (-2..=2).any(|c| wall_vertex(point, c) == vertex))
}

/// The 16 boundary vertices of a hole, from a corner, counter-clockwise with z
/// to the right and y up; or with y down.
fn rim(middle: u32, mirrored: bool) -> [u32; 16] {
    std::array::from_fn(|k| {
        let step = i32::try_from(k % 4).unwrap_or(0);
        let (column, row) = match k / 4 {
            0 => (2, step - 2),
            1 => (2 - step, 2),
            2 => (-2, 2 - step),
            _ => (step - 2, -2),
        };
        wall_vertex(middle.wrapping_add_signed(if mirrored { -row } else { row }), column)
    })
}

/// A tube along half an ellipse from the first rim to the second.
fn add_handle(mesh: &mut Mesh, rims: [[u32; 16]; 2]) {
    let centre =
        |rim: &[u32; 16]| rim.iter().map(|v| mesh.positions[*v as usize]).sum::<DVec3>() / 16.0;
    let (top, bottom) = (centre(&rims[0]), centre(&rims[1]));
    let (middle, rise, reach) = ((top + bottom) / 2.0, (top.y - bottom.y) / 2.0, 0.30);
    let hole_radius = 0.5 * (mesh.positions[rims[0][6] as usize].y - top.y) + 0.06;
    let mut rings = vec![rims[0]];
    for segment in 1..SEGMENTS {
        let (sin, cos) = (PI * f64::from(segment) / f64::from(SEGMENTS)).sin_cos();
        let along = DVec3::new(reach * cos, -rise * sin, 0.0).normalize();
        let across = DVec3::new(-along.y, along.x, 0.0);
        let axis = middle + DVec3::new(reach * sin, rise * cos, 0.0);
        let radius = 0.065 + (hole_radius - 0.065) * (1.0 - sin).powi(4);
        let first = index(mesh.positions.len());
        mesh.positions.extend((0..16).map(|k| {
            let (up, side) = (PI * (f64::from(k) / 8.0 - 0.25)).sin_cos();
            axis + radius * (side * DVec3::Z + up * across)
        }));
        rings.push(std::array::from_fn(|k| first + index(k)));
    }
    rings.push(rims[1]);
    for pair in rings.windows(2) {
        for k in 0..16 {
            let next = (k + 1) % 16;
            let [a, b, c, d] = [pair[0][k], pair[1][k], pair[1][next], pair[0][next]];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}
