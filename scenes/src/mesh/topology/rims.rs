//! The rims of an open mesh.

use super::edges::{edges, sides};
use crate::Mesh;
use std::collections::HashMap;

/// A chain of edges that have a triangle on one side only.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rim {
    /// Vertices, in the sense of the triangles beside it.
    pub vertices: Vec<u32>,
    /// The last leads back to the first. False only where triangles disagree about
    /// their sense.
    pub is_ring: bool,
}

/// The rims of a mesh. Where several touch in a vertex, each ends as soon as it comes
/// back to where it has been.
#[must_use]
pub fn rims(mesh: &Mesh) -> Vec<Rim> {
    let sides = sides(mesh);
    let mut next: HashMap<u32, Vec<u32>> = HashMap::new();
    let mut starts = Vec::new();
    for edge in edges(&sides).filter(|edge| edge.len() == 1) {
        let (low, high) = (edge[0].low, edge[0].high);
        let (from, to) = if edge[0].is_forward(mesh) { (low, high) } else { (high, low) };
        next.entry(from).or_default().push(to);
        starts.push(from);
    }
    let mut rims = Vec::new();
    for start in starts {
        let mut chain = vec![start];
        let mut place: HashMap<u32, usize> = HashMap::from([(start, 0)]);
        while let Some(to) = chain.last().and_then(|at| next.get_mut(at)?.pop()) {
            // Back where it was: what lies between is a loop of its own.
            if let Some(begin) = place.get(&to).copied() {
                let closed = chain.split_off(begin);
                closed.iter().for_each(|vertex| {
                    place.remove(vertex);
                });
                rims.push(Rim { vertices: closed, is_ring: true });
            }
            place.insert(to, chain.len());
            chain.push(to);
        }
        if chain.len() > 1 {
            rims.push(Rim { vertices: chain, is_ring: false });
        }
    }
    rims
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::cube;

    /// Two holes that touch in a vertex are two loops.
    #[test]
    fn holes_that_touch_are_told_apart() {
        let mut mesh = cube(2);
        let at = |x: f64, y: f64| {
            mesh.positions.iter().position(|p| *p == glam::DVec3::new(x, y, 1.0)).map(|i| i as u32)
        };
        let middle = at(0.0, 0.0);
        let has = |t: &[u32; 3], v: Option<u32>| t.iter().any(|i| Some(*i) == v);
        let corners = [at(1.0, 1.0), at(-1.0, -1.0)];
        // The two quads at opposite corners of a side, which share its middle.
        let sides = [[at(1.0, 0.0), at(0.0, 1.0)], [at(-1.0, 0.0), at(0.0, -1.0)]];
        mesh.triangles.retain(|t| {
            let is_in = |i: usize| {
                let known = [middle, corners[i], sides[i][0], sides[i][1]];
                t.iter().all(|v| known.contains(&Some(*v)))
            };
            !(is_in(0) || is_in(1)) || !has(t, middle) && !has(t, corners[0]) && !has(t, corners[1])
        });
        assert_eq!(mesh.triangles.len(), 44);
        let rims = rims(&mesh);
        assert_eq!(rims.iter().map(|rim| rim.vertices.len()).collect::<Vec<_>>(), [4, 4]);
        assert!(rims.iter().all(|rim| rim.is_ring));
    }
}
