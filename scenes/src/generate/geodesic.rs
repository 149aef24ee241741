//! Balls from a subdivided icosahedron, plain and displaced.

use super::grid::index;
use crate::Mesh;
use crate::noise::fbm;
use glam::DVec3;
use std::collections::HashMap;

/// Corners of the icosahedron's faces, counter-clockwise seen from outside.
const FACES: [[usize; 3]; 20] = [
    [0, 1, 8],
    [0, 10, 1],
    [0, 4, 5],
    [0, 8, 4],
    [0, 5, 10],
    [1, 7, 6],
    [1, 6, 8],
    [1, 10, 7],
    [2, 9, 3],
    [2, 3, 11],
    [2, 5, 4],
    [2, 4, 9],
    [2, 11, 5],
    [3, 6, 7],
    [3, 9, 6],
    [3, 7, 11],
    [4, 8, 9],
    [5, 11, 10],
    [6, 9, 8],
    [7, 10, 11],
];

fn corners() -> [DVec3; 12] {
    let golden = 0.5 * (1.0 + 5.0f64.sqrt());
    let mut corners = [DVec3::ZERO; 12];
    for (i, corner) in corners.iter_mut().enumerate() {
        let [a, b] = [i & 1, (i >> 1) & 1].map(|bit| 1.0 - 2.0 * bit as f64);
        let v = DVec3::new(0.0, a, b * golden);
        *corner = [v, DVec3::new(v.y, v.z, v.x), DVec3::new(v.z, v.x, v.y)][i / 4];
    }
    corners
}

/// Ball of unit radius from an icosahedron whose edges are divided into
/// `frequency` parts: 20 · frequency² triangles of nearly equal size.
#[must_use]
pub fn geodesic(frequency: u32) -> Mesh {
    let frequency = frequency.max(1);
    let mut maker = Maker { frequency, mesh: Mesh::default(), edges: HashMap::new() };
    let corners = corners();
    maker.mesh.positions.extend(corners.map(DVec3::normalize));
    for face in FACES {
        maker.add_face(face, face.map(|i| corners[i]));
    }
    maker.mesh
}

struct Maker {
    frequency: u32,
    mesh: Mesh,
    /// First vertex inside each edge, running from the smaller corner.
    edges: HashMap<(usize, usize), u32>,
}

impl Maker {
    /// Vertex `step` parts from corner `a` towards `b`; edges are made once.
    fn on_edge(&mut self, [a, b]: [usize; 2], at: [DVec3; 2], step: u32) -> u32 {
        let f = self.frequency;
        if step == 0 || step == f {
            return index(if step == 0 { a } else { b });
        }
        let ordered = a < b;
        let (key, ends) = if ordered { ((a, b), at) } else { ((b, a), [at[1], at[0]]) };
        let positions = &mut self.mesh.positions;
        let first = *self.edges.entry(key).or_insert_with(|| {
            let first = index(positions.len());
            let inner = (1..f).map(|i| ends[0].lerp(ends[1], f64::from(i) / f64::from(f)));
            positions.extend(inner.map(DVec3::normalize));
            first
        });
        first + if ordered { step } else { f - step } - 1
    }

    fn add_face(&mut self, face: [usize; 3], at: [DVec3; 3]) {
        let f = self.frequency;
        // Vertex (i, j) lies at (1 - (i + j)/f) a + i/f b + j/f c.
        let mut rows: Vec<Vec<u32>> = Vec::with_capacity(f as usize + 1);
        for j in 0..=f {
            let mut row = Vec::with_capacity((f - j) as usize + 1);
            for i in 0..=f - j {
                row.push(if j == 0 {
                    self.on_edge([face[0], face[1]], [at[0], at[1]], i)
                } else if i == 0 {
                    self.on_edge([face[0], face[2]], [at[0], at[2]], j)
                } else if i + j == f {
                    self.on_edge([face[1], face[2]], [at[1], at[2]], j)
                } else {
                    let [b, c] = [i, j].map(|k| f64::from(k) / f64::from(f));
                    let position = at[0] + (at[1] - at[0]) * b + (at[2] - at[0]) * c;
                    self.mesh.positions.push(position.normalize());
                    index(self.mesh.positions.len() - 1)
                });
            }
            rows.push(row);
        }
        for (j, pair) in rows.windows(2).enumerate() {
            let (low, high) = (&pair[0], &pair[1]);
            for i in 0..f as usize - j {
                self.mesh.triangles.push([low[i], low[i + 1], high[i]]);
                if i + 1 < high.len() {
                    self.mesh.triangles.push([low[i + 1], high[i + 1], high[i]]);
                }
            }
        }
    }
}

/// Moves every vertex of a unit ball along its radius to `radius(direction)`.
/// Stays free of self-intersections where the radius is positive.
#[must_use]
pub fn displaced(ball: Mesh, mut radius: impl FnMut(DVec3) -> f64) -> Mesh {
    ball.with_positions(|p| p * radius(p))
}

/// A ball with bumps of 4 octaves, 20 · frequency² triangles.
#[must_use]
pub fn noisy_ball(frequency: u32, amplitude: f64, seed: u64) -> Mesh {
    displaced(geodesic(frequency), |p| 1.0 + amplitude * fbm(p * 3.0, 4, seed).value)
}

/// Radius of a lumpy, concave figure: folds where the noise is near zero.
pub(super) fn folded(p: DVec3, seed: u64) -> f64 {
    let ridge = fbm(p * 1.4, 2, seed).value;
    let detail = fbm(p * 4.0, 2, seed.wrapping_add(1)).value;
    0.7 + 0.9 * (ridge * ridge + 0.01).sqrt() + 0.05 * detail
}
