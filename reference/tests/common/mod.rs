//! Small closed bodies and scenes to test with.
#![allow(dead_code, reason = "each test file uses its part")]
#![allow(unreachable_pub, reason = "shared by test files")]

use glam::DVec3;
use scenes::scene::{Normals, Sequence};
use scenes::{Camera, MediumId, Mesh, Object, Projection};
use scenes::{Scene, Shape};
use std::collections::HashMap;

/// The corners of an icosahedron on the unit sphere.
fn icosahedron_corners() -> Vec<DVec3> {
    let g = (1.0 + 5.0_f64.sqrt()) / 2.0;
    [
        [-1.0, g, 0.0],
        [1.0, g, 0.0],
        [-1.0, -g, 0.0],
        [1.0, -g, 0.0],
        [0.0, -1.0, g],
        [0.0, 1.0, g],
        [0.0, -1.0, -g],
        [0.0, 1.0, -g],
        [g, 0.0, -1.0],
        [g, 0.0, 1.0],
        [-g, 0.0, -1.0],
        [-g, 0.0, 1.0],
    ]
    .map(|p| DVec3::from_array(p).normalize())
    .to_vec()
}

/// Its triangles.
const ICOSAHEDRON: [[u32; 3]; 20] = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
];

/// A unit sphere from an icosahedron whose triangles are divided `levels` times.
pub fn icosphere(levels: u32) -> Mesh {
    let mut positions = icosahedron_corners();
    let mut triangles = ICOSAHEDRON.to_vec();
    for _ in 0..levels {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut next = Vec::new();
        for [a, b, c] in triangles {
            let mut middle = |p: u32, q: u32| {
                *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    let m = (positions[p as usize] + positions[q as usize]).normalize();
                    positions.push(m);
                    positions.len() as u32 - 1
                })
            };
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            next.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        triangles = next;
    }
    Mesh { positions, triangles, normals: None }
}

/// A cube of edge 2 whose faces are divided n x n.
pub fn cube(n: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let mut index: HashMap<[u64; 3], u32> = HashMap::new();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut at = |i: u32, j: u32| {
                let [u, v] = [i, j].map(|k| 2.0 * f64::from(k) / f64::from(n) - 1.0);
                let mut p = DVec3::ZERO;
                p[axis] = sign;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                *index.entry(p.to_array().map(f64::to_bits)).or_insert_with(|| {
                    mesh.positions.push(p);
                    mesh.positions.len() as u32 - 1
                })
            };
            for i in 0..n {
                for j in 0..n {
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    let quad =
                        if sign > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
                    mesh.triangles.extend(quad);
                }
            }
        }
    }
    mesh
}

/// A closed surface of revolution about y from a closed profile (radius, y),
/// counter-clockwise in the (radius, y) plane.
pub fn lathe(profile: &[[f64; 2]], around: u32) -> Mesh {
    let count = profile.len() as u32;
    let mut mesh = Mesh::default();
    for i in 0..around {
        let angle = f64::from(i) / f64::from(around) * std::f64::consts::TAU;
        let ring = profile.iter().map(|[r, y]| DVec3::new(r * angle.cos(), *y, r * angle.sin()));
        mesh.positions.extend(ring);
    }
    for i in 0..around {
        for j in 0..count {
            let at = |i: u32, j: u32| (i % around) * count + j % count;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, d, c], [a, c, b]]);
        }
    }
    mesh
}

/// A ring.
pub fn torus() -> Mesh {
    let profile: Vec<[f64; 2]> = (0..16)
        .map(|i| f64::from(i) / 16.0 * std::f64::consts::TAU)
        .map(|a| [0.7 + 0.3 * a.cos(), 0.3 * a.sin()])
        .collect();
    lathe(&profile, 32)
}

/// A thick-walled cup without a bottom hole: bodies with cavities trap light.
pub fn cup() -> Mesh {
    let profile = [
        [0.02, -0.8],
        [0.35, -0.8],
        [0.6, -0.7],
        [0.75, -0.3],
        [0.8, 0.8],
        [0.72, 0.8],
        [0.66, -0.25],
        [0.5, -0.58],
        [0.3, -0.66],
        [0.02, -0.66],
    ];
    lathe(&profile, 40)
}

/// Every closed test mesh by name.
pub fn meshes() -> Vec<(&'static str, Mesh)> {
    vec![
        ("icosphere 320", icosphere(2)),
        ("icosphere 5120", icosphere(4)),
        ("cube 12", cube(1)),
        ("cube 1200", cube(10)),
        ("torus", torus()),
        ("cup", cup()),
    ]
}

/// An object of a medium at the origin.
pub fn object(shape: Shape, medium: u16, normals: Normals) -> Object {
    Object { normals, ..Object::solid("body", shape, MediumId(medium)) }
}

/// Objects in a uniform environment of radiance 1, media glass (index 1) and
/// vacuum (index 0).
pub fn furnace(objects: Vec<Object>, eta: f64) -> Scene {
    let camera = Camera {
        eye: DVec3::new(1.3, 1.1, 2.9),
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection: Projection::Perspective { vertical_fov_deg: 40.0 },
        resolution_px: [64, 64],
    };
    Scene {
        sequence: Sequence { frames: 1, seconds_per_frame: 0.04 },
        ..test_support::scene(objects, eta, camera)
    }
}
