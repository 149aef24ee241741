//! Built-in meshes by name, with the triangle counts of the papers' models.
//!
//! Every body is closed and faces outwards unless its description says
//! otherwise, measures about a metre or two, and brings smooth normals with
//! creases where its faces meet at an angle.

mod gem;
mod geodesic;
mod grid;
mod mug;
mod nested;
mod revolve;
mod solid;
mod teapot;

pub use gem::{Brilliant, brilliant};
pub use geodesic::{displaced, geodesic, noisy_ball};
pub use mug::mug;
pub use nested::{
    ball_with_bubble, edge_to_edge, fan, half_flipped, nested_shells, shell, slivers, thin_wall,
};
pub use revolve::{cup, half_ball, lens, revolve, torus, uv_sphere};
pub use solid::{corner_cube, cube, cuboid, extruded, gear, ice_cube, landscape, prism};
pub use teapot::{teapot, teapot_newell};

use crate::{Mesh, Shape, mesh::CornerNormals, normals};
use glam::{DVec2, DVec3};
use std::borrow::Cow;

/// Edges sharper than this stay sharp in the built-in meshes' normals, degrees.
pub const CREASE_DEG: f64 = 40.0;
/// Bodies of flat facets, whatever the angle between them.
const FACETED: [&str; 7] =
    ["brilliant", "prism", "cube", "corner-cube", "gear", "thin-wall", "edge-to-edge"];
/// Largest frequency of `geodesic-N`: 20 million triangles.
const MOST_FREQUENT: u32 = 1000;

/// Names that [`builtin`] knows, each with a line for people.
pub const NAMES: &[(&str, &str)] = &[
    ("teapot", "Newell's teapot as three overlapping closed solids: 14,512 triangles"),
    ("teapot-newell", "Newell's 32 patches as published, open: 14,400 triangles"),
    ("sphere-960", "unit ball, 32 slices and 16 stacks: 960 triangles"),
    ("ice-cube", "rounded cube with bumps, half edge 1 m: 4,800 triangles"),
    ("landscape", "height field over 20 x 20 m, open, for opaque ground: 2,340 triangles"),
    ("cup", "drinking cup, 1 m tall: 7,100 triangles"),
    ("mug", "mug with a handle, 1 m tall, genus 1: 3,746 triangles"),
    ("figure-50k", "folded figure in place of Wyman's Buddha, 2 m tall: 50,000 triangles"),
    ("figure-100k", "folded figure in place of Wyman's Venus, 2 m tall: 100,000 triangles"),
    ("noisy-ball", "unit ball with bumps: 81,920 triangles"),
    ("geodesic-N", "unit ball, icosahedron's edges divided in N (1 to 1000): 20 N² triangles"),
    ("brilliant", "round brilliant cut with 57 facets, girdle radius 1 m: 110 triangles"),
    ("shell", "hollow ball, radii 1 and 0.8 m: 10,240 triangles"),
    ("bubble-ball", "unit ball with an air bubble off its centre: 10,240 triangles"),
    ("nested-shells", "four concentric shells: 10,240 triangles"),
    ("torus", "ring about the y axis, radii 1 and 0.4 m: 8,192 triangles"),
    ("half-ball", "upper half of the unit ball: 4,032 triangles"),
    ("lens", "biconvex lens about the y axis, rim radius 1 m: 6,016 triangles"),
    ("prism", "equilateral prism along z, circumradius 1 m: 12 triangles"),
    ("cube", "cube of half edge 1 m: 12 triangles"),
    ("corner-cube", "retroreflecting tetrahedron with legs of 1 m: 4 triangles"),
    ("gear", "wheel with 16 teeth, radius 1 m, axis along z: 256 triangles"),
    ("thin-wall", "pane of 2 x 2 m, 1 mm thick: 12 triangles"),
    ("slivers", "unit ball cut into slivers of aspect 1e6: 3,840 triangles"),
    ("edge-to-edge", "two boxes that share one edge, closed but not a manifold: 24 triangles"),
    ("fan", "three triangles on one edge, open: 3 triangles"),
    ("half-flipped", "unit ball with every second triangle turned over: 1,280 triangles"),
];

/// Divisions of what stands for a round shape: its facets lie within 2e-4 of the
/// radius below the surface.
const ROUND: u32 = 32;

/// A shape's triangles: a mesh itself, a box exactly, a ball or cylinder nearly;
/// `None` for what has no bounds. Without normals for analytic shapes.
#[must_use]
pub fn triangulated(shape: &Shape) -> Option<Cow<'_, Mesh>> {
    let mesh = match *shape {
        Shape::Mesh(ref mesh) => return Some(Cow::Borrowed(mesh)),
        Shape::Sphere { radius_m } => geodesic(ROUND).with_positions(|p| radius_m * p),
        Shape::Box { half_extent_m } => cuboid(half_extent_m),
        Shape::Cylinder { radius_m: r, half_height_m: h } => {
            let profile = [(0.0, -h), (r, -h), (r, h), (0.0, h)];
            revolve(&profile.map(|(x, y)| DVec2::new(x, y)), 6 * ROUND, false)
        }
        Shape::Slab { .. } | Shape::HalfSpace => return None,
    };
    Some(Cow::Owned(Mesh { normals: None, ..mesh }))
}

/// A built-in mesh, or `None` if there is none of that name.
#[must_use]
pub fn builtin(name: &str) -> Option<Mesh> {
    if let Some(frequency) = name.strip_prefix("geodesic-") {
        let frequency = frequency.parse().ok().filter(|f| (1..=MOST_FREQUENT).contains(f))?;
        return Some(round(geodesic(frequency)));
    }
    let mesh = match name {
        "sphere-960" => return Some(round(uv_sphere(32, 16))),
        "teapot" => teapot(15),
        "teapot-newell" => teapot_newell(15),
        "ice-cube" => ice_cube(20, 0.03, 1),
        "landscape" => landscape(10.0, 2.0, 1),
        "cup" => cup(),
        "mug" => mug(),
        "figure-50k" => figure(geodesic(50), 2),
        "figure-100k" => figure(uv_sphere(250, 201), 3),
        "noisy-ball" => noisy_ball(64, 0.15, 1),
        "brilliant" => brilliant(Brilliant::default()),
        "shell" => shell(16, 0.8),
        "bubble-ball" => ball_with_bubble(16, 0.3, DVec3::new(0.2, 0.25, 0.0)),
        "nested-shells" => nested_shells(4, 8),
        "torus" => torus(1.0, 0.4, 128, 32),
        "half-ball" => half_ball(63, 32),
        "lens" => lens(1.5, 64, 24),
        "prism" => prism(1.0),
        "cube" => cube(1),
        "corner-cube" => corner_cube(),
        "gear" => gear(16, 0.2),
        "thin-wall" => thin_wall(1e-3),
        "slivers" => slivers(8, 1e6),
        "edge-to-edge" => edge_to_edge(),
        "fan" => fan(),
        "half-flipped" => half_flipped(8),
        _ => return None,
    };
    let is_faceted = FACETED.contains(&name);
    let shading =
        if is_faceted { normals::flat(&mesh) } else { normals::creased(&mesh, CREASE_DEG) };
    Some(Mesh { normals: Some(shading), ..mesh })
}

/// A standing body with deep folds, 2 m tall.
fn figure(ball: Mesh, seed: u64) -> Mesh {
    let body = displaced(ball, |p| geodesic::folded(p, seed));
    let [low, high] = body.bounds();
    let size = 2.0 / (high.y - low.y);
    body.with_positions(|p| (p * DVec3::new(0.6, 1.0, 0.6) - DVec3::Y * low.y) * size)
}

/// A unit ball with its exact normals.
fn round(mut ball: Mesh) -> Mesh {
    ball.normals =
        Some(CornerNormals { values: ball.positions.clone(), indices: ball.triangles.clone() });
    ball
}

#[cfg(test)]
mod tests;
