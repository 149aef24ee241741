//! The sides of a mesh's triangles, sorted so that equal edges lie together.

use crate::Mesh;
use rayon::prelude::*;

/// One side of one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// Smaller vertex index.
    pub(crate) low: u32,
    /// Larger vertex index.
    pub(crate) high: u32,
    /// Three times the triangle's index plus the corner where the side starts.
    pub(crate) corner: u32,
}

impl Side {
    /// Index of the triangle.
    pub(crate) fn triangle(self) -> usize {
        self.corner as usize / 3
    }

    /// True where the triangle runs from `low` to `high`.
    pub(crate) fn is_forward(self, mesh: &Mesh) -> bool {
        mesh.triangles[self.triangle()][self.corner as usize % 3] == self.low
    }
}

/// All sides, sorted by edge. Triangles that use a vertex twice have no sides
/// here.
pub(crate) fn sides(mesh: &Mesh) -> Vec<Side> {
    let mut sides: Vec<Side> = mesh
        .triangles
        .par_iter()
        .enumerate()
        .filter(|(_, [a, b, c])| a != b && b != c && c != a)
        .flat_map_iter(|(index, triangle)| {
            (0..3usize).map(move |corner| {
                let [from, to] = [triangle[corner], triangle[(corner + 1) % 3]];
                let corner = u32::try_from(3 * index + corner).unwrap_or(u32::MAX);
                Side { low: from.min(to), high: from.max(to), corner }
            })
        })
        .collect();
    sides.par_sort_unstable();
    sides
}

/// Slices of equal edges.
pub(crate) fn edges(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high))
}

/// Disjoint sets by union with path halving.
pub(crate) struct Sets(Vec<u32>);

impl Sets {
    /// Every member alone.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..u32::try_from(count).unwrap_or(u32::MAX)).collect())
    }

    /// Smallest member of a set.
    pub(crate) fn root(&mut self, mut member: u32) -> u32 {
        while self.0[member as usize] != member {
            let above = self.0[self.0[member as usize] as usize];
            self.0[member as usize] = above;
            member = above;
        }
        member
    }

    /// Makes one set of two.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
