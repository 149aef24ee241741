//! Bodies with flat faces, and the rounded cube.

use super::grid::{add_patch, index};
use crate::noise::fbm;
use crate::{Mesh, topology::weld};
use glam::{DVec2, DVec3};

/// Axes that span the six sides of a cube: right, up (seen from outside), out.
const SIDES: [[DVec3; 3]; 6] = [
    [DVec3::NEG_Z, DVec3::Y, DVec3::X],
    [DVec3::Z, DVec3::Y, DVec3::NEG_X],
    [DVec3::X, DVec3::NEG_Z, DVec3::Y],
    [DVec3::X, DVec3::Z, DVec3::NEG_Y],
    [DVec3::X, DVec3::Y, DVec3::Z],
    [DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z],
];

/// Surface of the cube |x|, |y|, |z| ≤ 1 with `divisions`² quads per side.
#[must_use]
pub fn cube(divisions: u32) -> Mesh {
    let mut mesh = Mesh::default();
    // Odd in `i`, so that opposite ways along an edge give the same bits.
    let at = |i: u32| (2.0 * f64::from(i) - f64::from(divisions)) / f64::from(divisions);
    for [right, up, out] in SIDES {
        add_patch(&mut mesh, divisions, divisions, |i, j| right * at(i) + up * at(j) + out);
    }
    weld(&mesh)
}

/// Box about the origin: 12 triangles.
#[must_use]
pub fn cuboid(half_extent_m: DVec3) -> Mesh {
    cube(1).with_positions(|p| p * half_extent_m)
}

/// Half-melted ice cube within about |x| ≤ 1.03: a cube of 6 · 2 · divisions²
/// triangles rounded to |x|⁶ + |y|⁶ + |z|⁶ = 1, then moved radially by noise of
/// 3 octaves and the given amplitude. 20 divisions: 4,800 triangles.
#[must_use]
pub fn ice_cube(divisions: u32, amplitude: f64, seed: u64) -> Mesh {
    cube(divisions).with_positions(|p| {
        let sixth = (p * p * p * p * p * p).element_sum();
        let round = p * sixth.powf(-1.0 / 6.0);
        round * (1.0 + amplitude * fbm(round * 2.0, 3, seed).value)
    })
}

/// Prism about the origin with a polygon in the x-y plane, counter-clockwise,
/// that sees the origin from every corner; from z = -half_length_m to
/// +half_length_m.
#[must_use]
pub fn extruded(outline: &[DVec2], half_length_m: f64) -> Mesh {
    let count = index(outline.len());
    let mut mesh = Mesh::default();
    for z in [-half_length_m, half_length_m] {
        mesh.positions.extend(outline.iter().map(|p| p.extend(z)));
        mesh.positions.push(DVec3::new(0.0, 0.0, z));
    }
    let (back, front) = (count, 2 * count + 1);
    for i in 0..count {
        let j = (i + 1) % count;
        let [a, b, c, d] = [i, j, j + back + 1, i + back + 1];
        mesh.triangles.extend([[a, b, c], [a, c, d], [back, b, a], [front, d, c]]);
    }
    mesh
}

/// Equilateral prism of unit circumradius, axis along z, apex up.
#[must_use]
pub fn prism(half_length_m: f64) -> Mesh {
    let outline: Vec<DVec2> =
        (0..3).map(|i| DVec2::from_angle((90.0 + 120.0 * f64::from(i)).to_radians())).collect();
    extruded(&outline, half_length_m)
}

/// Gear wheel of unit tip radius, axis along z.
#[must_use]
pub fn gear(teeth: u32, half_length_m: f64) -> Mesh {
    let outline: Vec<DVec2> = (0..teeth)
        .flat_map(|tooth| {
            [(0.0, 0.75), (0.15, 1.0), (0.45, 1.0), (0.6, 0.75)].map(|(turn, radius)| {
                let angle = std::f64::consts::TAU * (f64::from(tooth) + turn) / f64::from(teeth);
                radius * DVec2::from_angle(angle)
            })
        })
        .collect();
    extruded(&outline, half_length_m)
}

/// Corner cube: the tetrahedron cut from a cube's corner at the origin by the
/// plane x + y + z = 1. Light that enters through that plane and meets the
/// three others returns the way it came.
#[must_use]
pub fn corner_cube() -> Mesh {
    Mesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![[1, 2, 3], [0, 2, 1], [0, 3, 2], [0, 1, 3]],
        normals: None,
    }
}

/// Height field over |x|, |z| ≤ half_size_m, seen from above; open, for opaque
/// ground. 30 x 39 quads: 2,340 triangles.
#[must_use]
pub fn landscape(half_size_m: f64, height_m: f64, seed: u64) -> Mesh {
    let (columns, rows) = (30, 39);
    let mut mesh = Mesh::default();
    add_patch(&mut mesh, columns, rows, |i, j| {
        let x = 2.0 * f64::from(i) / f64::from(columns) - 1.0;
        let z = 1.0 - 2.0 * f64::from(j) / f64::from(rows);
        let height = fbm(DVec3::new(2.0 * x, 0.0, 2.0 * z), 5, seed).value;
        DVec3::new(half_size_m * x, height_m * height, half_size_m * z)
    });
    mesh
}
