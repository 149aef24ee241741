//! Counts that say what kind of surface a mesh is.

use super::edges::{Sets, Side, edges, sides};
use super::weld::{cyclic, is_degenerate};
use crate::Mesh;
use std::collections::HashSet;

/// What [`inspect`] found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// All triangles.
    pub triangles: usize,
    /// Triangles without area.
    pub degenerate: usize,
    /// Triangles that repeat an earlier one, in the same sense.
    pub duplicate: usize,
    /// Edges of one triangle only.
    pub boundary_edges: usize,
    /// Edges of three or more triangles.
    pub non_manifold_edges: usize,
    /// Edges that two triangles run along in the same sense: one of the two
    /// faces the wrong way.
    pub inconsistent_edges: usize,
    /// Edges that are not used equally often in both senses. Only without any
    /// is a winding number defined.
    pub unbalanced_edges: usize,
    /// Vertices where more than one fan of triangles meets.
    pub pinched_vertices: usize,
    /// Parts that hang together by edges.
    pub components: usize,
    /// Vertices - edges + triangles, of those in use; 2 (components - genus)
    /// for closed manifolds.
    pub euler_characteristic: i64,
    /// Positive for closed surfaces that face outwards, m³; overlaps count
    /// twice.
    pub signed_volume_m3: f64,
}

impl Report {
    /// True when a winding number is defined everywhere off the surface.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.triangles > 0 && self.unbalanced_edges == 0
    }

    /// True when every point of the closed surface looks like a disc.
    #[must_use]
    pub fn is_manifold(&self) -> bool {
        self.is_closed()
            && self.boundary_edges + self.non_manifold_edges + self.pinched_vertices == 0
    }
}

fn is_unbalanced(mesh: &Mesh, edge: &[Side]) -> bool {
    2 * edge.iter().filter(|side| side.is_forward(mesh)).count() != edge.len()
}

/// Examines a welded mesh.
#[must_use]
pub fn inspect(mesh: &Mesh) -> Report {
    let sides = sides(mesh);
    let mut report = Report {
        triangles: mesh.triangles.len(),
        degenerate: (0..mesh.triangles.len()).filter(|i| is_degenerate(mesh, *i)).count(),
        duplicate: duplicates(mesh),
        signed_volume_m3: signed_volume(mesh),
        ..Report::default()
    };
    let mut parts = Sets::new(mesh.triangles.len());
    let mut fans = Sets::new(3 * mesh.triangles.len());
    let mut edge_count = 0;
    for edge in edges(&sides) {
        edge_count += 1;
        let forward = edge.iter().filter(|side| side.is_forward(mesh)).count();
        report.boundary_edges += usize::from(edge.len() == 1);
        report.non_manifold_edges += usize::from(edge.len() > 2);
        report.inconsistent_edges += usize::from(edge.len() == 2 && forward != 1);
        report.unbalanced_edges += usize::from(is_unbalanced(mesh, edge));
        for side in edge {
            parts.join(edge[0].corner / 3, side.corner / 3);
            for vertex in [side.low, side.high] {
                fans.join(
                    corner_at(mesh, edge[0].triangle(), vertex),
                    corner_at(mesh, side.triangle(), vertex),
                );
            }
        }
    }
    let used: Vec<usize> = (0..mesh.triangles.len()).filter(|i| has_three(mesh, *i)).collect();
    report.components = used.iter().filter(|i| parts.root(as_u32(**i)) == as_u32(**i)).count();
    let (vertices, pinched) = vertices(mesh, &used, &mut fans);
    report.pinched_vertices = pinched;
    report.euler_characteristic = vertices as i64 - i64::from(edge_count) + used.len() as i64;
    report
}

/// Volume by the divergence theorem, m³, relative to the first vertex so that
/// distance from the origin does not matter.
#[must_use]
pub fn signed_volume(mesh: &Mesh) -> f64 {
    let Some(origin) = mesh.positions.first().copied() else { return 0.0 };
    (0..mesh.triangles.len())
        .map(|index| {
            let [a, b, c] = mesh.corners(index).map(|p| p - origin);
            a.dot(b.cross(c)) / 6.0
        })
        .sum()
}

fn as_u32(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

fn has_three(mesh: &Mesh, triangle: usize) -> bool {
    let [a, b, c] = mesh.triangles[triangle];
    a != b && b != c && c != a
}

fn corner_at(mesh: &Mesh, triangle: usize, vertex: u32) -> u32 {
    let corner = mesh.triangles[triangle].iter().position(|v| *v == vertex).unwrap_or(0);
    as_u32(3 * triangle + corner)
}

/// How many vertices are in use, and at how many of them several fans meet.
fn vertices(mesh: &Mesh, used: &[usize], fans: &mut Sets) -> (usize, usize) {
    let mut fan_of = vec![u32::MAX; mesh.positions.len()];
    let mut is_pinched = vec![false; mesh.positions.len()];
    for triangle in used {
        for (corner, vertex) in mesh.triangles[*triangle].iter().enumerate() {
            let fan = fans.root(as_u32(3 * triangle + corner));
            let known = &mut fan_of[*vertex as usize];
            is_pinched[*vertex as usize] |= *known != u32::MAX && *known != fan;
            *known = fan;
        }
    }
    let count = fan_of.iter().filter(|fan| **fan != u32::MAX).count();
    (count, is_pinched.iter().filter(|pinched| **pinched).count())
}

fn duplicates(mesh: &Mesh) -> usize {
    let mut seen = HashSet::with_capacity(mesh.triangles.len());
    mesh.triangles.iter().filter(|triangle| !seen.insert(cyclic(**triangle))).count()
}
