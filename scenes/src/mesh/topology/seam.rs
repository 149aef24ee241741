//! Copies of one vertex that differ in their last bits, as along the seam of a
//! ball made with sine and cosine.

use super::edges::{Sets, edges, sides};
use crate::Mesh;
use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// Vertices nearer to each other than this share of the body's diagonal are
/// copies of one, if both lie on open edges: several steps of an f32 that holds a
/// coordinate as large as the body, or one of a text with six decimals.
pub const SEAM: f64 = 1e-6;

/// What [`close_seams`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seams {
    /// Vertices that were taken for another.
    pub merged: usize,
    /// Largest distance between two that became one, metres.
    pub largest_gap_m: f64,
}

impl Seams {
    /// What a user is told.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        (self.merged > 0).then(|| {
            format!(
                "{} vertices along open edges were taken for others that lie up to {:.1e} m away, \
                 less than {SEAM:e} of the body",
                self.merged, self.largest_gap_m
            )
        })
    }
}

/// Merges vertices of open edges that lie within [`SEAM`] of each other, the later
/// into the earlier. A closed mesh stays as it is, and so does everything but the
/// rims of an open one; the ends of one edge are never merged.
#[must_use]
pub fn close_seams(mesh: &Mesh) -> (Mesh, Seams) {
    let sides = sides(mesh);
    let open: Vec<[u32; 2]> = edges(&sides)
        .filter(|edge| edge.len() == 1)
        .map(|edge| [edge[0].low, edge[0].high])
        .collect();
    let [low, high] = mesh.bounds();
    let reach_m = SEAM * (high - low).length();
    if open.is_empty() || !(reach_m > 0.0 && reach_m.is_finite()) {
        return (mesh.clone(), Seams::default());
    }
    let mut sets = joined(mesh, &open, low, reach_m);
    let mut seams = Seams::default();
    let target: Vec<u32> = (0..mesh.positions.len() as u32).map(|i| sets.root(i)).collect();
    for (from, to) in mesh.positions.iter().zip(&target) {
        let gap_m = from.distance(mesh.positions[*to as usize]);
        seams.merged += usize::from(gap_m > 0.0);
        seams.largest_gap_m = seams.largest_gap_m.max(gap_m);
    }
    let triangles =
        mesh.triangles.iter().map(|triangle| triangle.map(|i| target[i as usize])).collect();
    (Mesh { triangles, ..mesh.clone() }, seams)
}

/// Which vertices are one.
fn joined(mesh: &Mesh, open: &[[u32; 2]], origin: DVec3, reach_m: f64) -> Sets {
    let mut sets = Sets::new(mesh.positions.len());
    let neighbours: HashSet<[u32; 2]> = open.iter().copied().collect();
    let mut rims: Vec<u32> = open.iter().flatten().copied().collect();
    rims.sort_unstable();
    rims.dedup();
    let mut in_cell: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    for vertex in rims {
        let at = mesh.positions[vertex as usize];
        let cell = ((at - origin) / reach_m).floor().to_array().map(|x| x as i64);
        for near in 0..27 {
            let [x, y, z] = [near % 3, near / 3 % 3, near / 9].map(|step| step - 1);
            let Some(others) = in_cell.get(&[cell[0] + x, cell[1] + y, cell[2] + z]) else {
                continue;
            };
            for other in others {
                let is_near = mesh.positions[*other as usize].distance(at) <= reach_m;
                if is_near && !neighbours.contains(&[*other, vertex]) {
                    sets.join(*other, vertex);
                }
            }
        }
        in_cell.entry(cell).or_default().push(vertex);
    }
    sets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{cube, geodesic};
    use crate::topology::{inspect, solid};

    /// A ball of slices and stacks whose seam and poles have copies, as sine and
    /// cosine of 2π in a precision of `digits` give them.
    fn ball(round: impl Fn(f64) -> f64) -> Mesh {
        let (slices, stacks) = (12u32, 6u32);
        let mut mesh = Mesh::default();
        for j in 0..=stacks {
            for i in 0..=slices {
                let turn = std::f64::consts::TAU * f64::from(i) / f64::from(slices);
                let fall = std::f64::consts::PI * f64::from(j) / f64::from(stacks);
                let p = DVec3::new(fall.sin() * turn.cos(), fall.cos(), -fall.sin() * turn.sin());
                mesh.positions.push(DVec3::from_array(p.to_array().map(&round)));
            }
        }
        for j in 0..stacks {
            for i in 0..slices {
                let at = |i: u32, j: u32| j * (slices + 1) + i;
                let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        mesh
    }

    fn closed(mesh: &Mesh) -> (bool, usize) {
        let (mesh, seams) = close_seams(&crate::topology::weld(mesh));
        let (mesh, _) = crate::topology::clean(&mesh);
        (solid(&mesh).is_ok(), seams.merged)
    }

    #[test]
    fn seams_of_the_last_bits_close_and_wider_ones_do_not() {
        let exact = ball(|x| x);
        assert!(!inspect(&crate::topology::weld(&exact)).is_closed());
        let (is_solid, merged) = closed(&exact);
        assert!(is_solid && merged > 5, "{merged}");
        assert!(closed(&ball(|x| f64::from(x as f32))).0);
        // A gap of a hundred thousandth of the body is a gap.
        let mut torn = exact;
        for p in torn.positions.iter_mut().skip(13).step_by(13) {
            p.z += 1e-4;
        }
        assert!(!closed(&torn).0);
    }

    /// The tolerance goes with the body.
    #[test]
    fn small_and_large_bodies_close_alike() {
        for scale in [1e-6, 1.0, 1e6] {
            assert!(closed(&ball(|x| x).with_positions(|p| p * scale)).0, "{scale}");
        }
    }

    #[test]
    fn closed_meshes_and_short_edges_stay() {
        let mut small = geodesic(8).with_positions(|p| p * 1e-7);
        small.append(&cube(1));
        assert_eq!(close_seams(&small), (small.clone(), Seams::default()));
        let mut open = small;
        open.triangles.swap_remove(3);
        let (after, seams) = close_seams(&open);
        assert!(seams.merged < 3, "{seams:?}");
        assert!(!inspect(&after).is_closed());
    }
}
