//! All that can be said of a mesh that is to become a body.

use super::orient::consistent;
use super::{NotSolid, Part, Report, depths, inspect, opposed, parts, rims, solid};
use crate::Mesh;
use glam::DVec3;

/// What a mesh is.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// Counts.
    pub report: Report,
    /// Corners of the box, metres; inverted infinities when empty.
    pub bounds: [DVec3; 2],
    /// Holes and other rims, the longest first.
    pub holes: Vec<Hole>,
    /// Triangles that must turn so that all agree; `None` if no choice makes them.
    pub wrong_way: Option<usize>,
    /// Triangles that are there in the opposite sense too.
    pub opposed: usize,
    /// Parts that hang together by edges, the largest first, each with the number
    /// of parts that it lies in.
    pub parts: Vec<(Part, usize)>,
    /// Why no renderer can fill it, if none can.
    pub flaw: Option<NotSolid>,
}

/// A rim of an open mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// Edges along it.
    pub edges: usize,
    /// Length along it, metres.
    pub length_m: f64,
    /// Mean of its vertices, object space, metres.
    pub centre: DVec3,
    /// It leads back to where it began.
    pub is_ring: bool,
}

/// Looks at a welded mesh.
#[must_use]
pub fn survey(mesh: &Mesh) -> Survey {
    let mut holes: Vec<Hole> = rims(mesh)
        .iter()
        .map(|rim| {
            let at = |i: usize| mesh.positions[rim.vertices[i % rim.vertices.len()] as usize];
            let count = rim.vertices.len();
            let edges = if rim.is_ring { count } else { count - 1 };
            Hole {
                edges,
                length_m: (0..edges).map(|i| at(i).distance(at(i + 1))).sum(),
                centre: (0..count).map(at).sum::<DVec3>() / count as f64,
                is_ring: rim.is_ring,
            }
        })
        .collect();
    holes.sort_by(|a, b| b.length_m.total_cmp(&a.length_m));
    let found = parts(mesh);
    let depths = depths(mesh, &found);
    let mut parts: Vec<(Part, usize)> = found.into_iter().zip(depths).collect();
    parts.sort_by_key(|(part, _)| std::cmp::Reverse(part.triangles.len()));
    Survey {
        report: inspect(mesh),
        bounds: mesh.bounds(),
        holes,
        wrong_way: consistent(mesh).ok().map(|turned| turned.iter().filter(|t| **t).count()),
        opposed: opposed(mesh),
        parts,
        flaw: solid(mesh).err(),
    }
}
