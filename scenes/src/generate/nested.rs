//! Bodies with cavities, and meshes that are wrong on purpose.

use super::geodesic::geodesic;
use super::solid::cuboid;
use crate::{Mesh, topology::weld};
use glam::DVec3;

fn ball(frequency: u32, radius_m: f64, centre_m: DVec3) -> Mesh {
    geodesic(frequency).with_positions(|p| centre_m + radius_m * p)
}

/// Hollow ball: outer radius 1, inner radius `inner_m`, the inner surface
/// facing the cavity.
#[must_use]
pub fn shell(frequency: u32, inner_m: f64) -> Mesh {
    ball_with_bubble(frequency, inner_m, DVec3::ZERO)
}

/// Unit ball with a spherical cavity.
#[must_use]
pub fn ball_with_bubble(frequency: u32, bubble_m: f64, centre_m: DVec3) -> Mesh {
    let mut mesh = geodesic(frequency);
    mesh.append(&ball(frequency, bubble_m, centre_m).reversed());
    mesh
}

/// `count` concentric shells, each as thick as the gap to the next; outermost
/// radius 1.
#[must_use]
pub fn nested_shells(count: u32, frequency: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for layer in 0..2 * count {
        let surface = ball(frequency, 1.0 - f64::from(layer) / f64::from(2 * count), DVec3::ZERO);
        mesh.append(&if layer % 2 == 0 { surface } else { surface.reversed() });
    }
    mesh
}

/// A pane with edges 2 m long and the given thickness along z.
#[must_use]
pub fn thin_wall(thickness_m: f64) -> Mesh {
    cuboid(DVec3::new(1.0, 1.0, 0.5 * thickness_m))
}

/// Three triangles on one edge: open and not a manifold.
#[must_use]
pub fn fan() -> Mesh {
    let around = |turn: f64| {
        let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
        DVec3::new(cos, 0.0, sin)
    };
    Mesh {
        positions: vec![DVec3::ZERO, DVec3::Y, around(0.0), around(1.0 / 3.0), around(2.0 / 3.0)],
        triangles: vec![[0, 1, 2], [0, 1, 3], [0, 1, 4]],
        normals: None,
    }
}

/// Two boxes that share one edge: closed, but four triangles meet at the edge.
#[must_use]
pub fn edge_to_edge() -> Mesh {
    let mut mesh = cuboid(DVec3::splat(0.5)).with_positions(|p| p - DVec3::new(0.5, 0.5, 0.0));
    mesh.append(&cuboid(DVec3::splat(0.5)).with_positions(|p| p + DVec3::new(0.5, 0.5, 0.0)));
    weld(&mesh)
}

/// Unit ball in which every triangle is cut in three by a point so close to its
/// first side that one of the three is a sliver of the given aspect ratio. The
/// surface stays closed and where it was.
#[must_use]
pub fn slivers(frequency: u32, aspect: f64) -> Mesh {
    let mut mesh = geodesic(frequency);
    for triangle in std::mem::take(&mut mesh.triangles) {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        let middle = 0.5 * (a + b);
        let inner = u32::try_from(mesh.positions.len()).unwrap_or(u32::MAX);
        mesh.positions.push(middle + (c - middle) / aspect);
        let [a, b, c] = triangle;
        mesh.triangles.extend([[a, b, inner], [b, c, inner], [c, a, inner]]);
    }
    mesh
}

/// The unit ball with every second triangle turned over.
#[must_use]
pub fn half_flipped(frequency: u32) -> Mesh {
    let mut mesh = geodesic(frequency);
    mesh.triangles.iter_mut().step_by(2).for_each(|triangle| triangle.swap(1, 2));
    mesh
}
