//! Parts that hang together by edges, and which of them lie in which.

use super::edges::{Sets, edges, sides};
use crate::Mesh;
use crate::distance::solid_angle;
use glam::DVec3;
use std::collections::HashMap;

/// Most triangles that are looked at to find out which part lies in which; beyond,
/// boxes alone decide. A second or two.
const MOST_LOOKS: usize = 50_000_000;

/// A part of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Indices of its triangles.
    pub triangles: Vec<u32>,
    /// Corners of its box, object space, metres.
    pub bounds: [DVec3; 2],
    /// Negative where it faces inwards, as cavities do, m³.
    pub signed_volume_m3: f64,
}

impl Part {
    fn new(mesh: &Mesh, triangles: Vec<u32>) -> Self {
        let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let origin = mesh.corners(triangles[0] as usize)[0];
        let mut volume = 0.0;
        for index in &triangles {
            let corners = mesh.corners(*index as usize);
            for p in corners {
                bounds = [bounds[0].min(p), bounds[1].max(p)];
            }
            let [a, b, c] = corners.map(|p| p - origin);
            volume += a.dot(b.cross(c)) / 6.0;
        }
        Self { triangles, bounds, signed_volume_m3: volume }
    }

    fn has_in_its_box(&self, other: &Self) -> bool {
        self.bounds[0].cmple(other.bounds[0]).all() && self.bounds[1].cmpge(other.bounds[1]).all()
    }

    /// True if a part's first triangle lies in this one.
    fn surrounds(&self, mesh: &Mesh, other: &Self) -> bool {
        let [a, b, c] = mesh.corners(other.triangles[0] as usize);
        let at = (a + b + c) / 3.0;
        let angles = self.triangles.iter().map(|i| solid_angle(mesh.corners(*i as usize), at));
        angles.sum::<f64>().abs() > 2.0 * std::f64::consts::PI
    }
}

/// The parts of a mesh, the one of the first triangle first.
#[must_use]
pub fn parts(mesh: &Mesh) -> Vec<Part> {
    let mut sets = Sets::new(mesh.triangles.len());
    let sides = sides(mesh);
    for edge in edges(&sides) {
        for side in &edge[1..] {
            sets.join(edge[0].corner / 3, side.corner / 3);
        }
    }
    let mut number: HashMap<u32, usize> = HashMap::new();
    let mut lists: Vec<Vec<u32>> = Vec::new();
    for triangle in 0..mesh.triangles.len() as u32 {
        let part = *number.entry(sets.root(triangle)).or_insert_with(|| {
            lists.push(Vec::new());
            lists.len() - 1
        });
        lists[part].push(triangle);
    }
    lists.into_iter().map(|list| Part::new(mesh, list)).collect()
}

/// For each part, how many others it lies in. Parts are taken to be closed and not
/// to cross each other.
#[must_use]
pub fn depths(mesh: &Mesh, parts: &[Part]) -> Vec<usize> {
    let mut looks = 0;
    let mut depths = vec![0; parts.len()];
    for (outer_index, outer) in parts.iter().enumerate() {
        let candidates: Vec<usize> = (0..parts.len())
            .filter(|inner| *inner != outer_index && outer.has_in_its_box(&parts[*inner]))
            .collect();
        for inner in candidates {
            looks += outer.triangles.len();
            depths[inner] +=
                usize::from(looks > MOST_LOOKS || outer.surrounds(mesh, &parts[inner]));
        }
    }
    depths
}

/// The first part that faces inwards and lies in no part that faces outwards.
pub(super) fn inverted_part<'a>(mesh: &Mesh, parts: &'a [Part]) -> Option<&'a Part> {
    let [low, high] = mesh.bounds();
    let none = 1e-14 * (high - low).length().powi(3);
    let mut looks = 0;
    parts.iter().filter(|part| part.signed_volume_m3 < -none).find(|part| {
        !parts.iter().any(|outer| {
            let may = outer.signed_volume_m3 > 0.0 && outer.has_in_its_box(part);
            looks += if may { outer.triangles.len() } else { 0 };
            may && (looks > MOST_LOOKS || outer.surrounds(mesh, part))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{cube, geodesic, nested_shells, shell};

    #[test]
    fn shells_lie_in_shells() {
        let mesh = nested_shells(4, 4);
        let found = parts(&mesh);
        assert_eq!(found.len(), 8);
        let mut depths = depths(&mesh, &found);
        depths.sort_unstable();
        assert_eq!(depths, [0, 1, 2, 3, 4, 5, 6, 7]);
        assert!(inverted_part(&mesh, &found).is_none());
    }

    /// Beside a body, within its box but not in it, and in it.
    #[test]
    fn an_inverted_part_is_a_cavity_only_inside() {
        for (at, is_cavity) in [(3.0, false), (0.92, false), (0.2, true)] {
            let mut mesh = geodesic(8);
            let small = cube(1).with_positions(|p| p * 0.05 + DVec3::splat(at)).reversed();
            mesh.append(&small);
            assert_eq!(inverted_part(&mesh, &parts(&mesh)).is_none(), is_cavity, "{at}");
        }
        let hollow = shell(4, 0.5);
        assert!(inverted_part(&hollow, &parts(&hollow)).is_none());
    }
}
