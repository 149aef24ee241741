//! A mesh's triangles sorted into columns along z: quick answers to which
//! triangles lie over a rectangle, and how often the mesh winds around a point.

use crate::Mesh;
use glam::{DVec2, DVec3};

/// The columns of one mesh.
pub(crate) struct Columns<'a> {
    mesh: &'a Mesh,
    low: DVec2,
    cell_m: DVec2,
    /// Columns along x and y.
    size: [usize; 2],
    members: Vec<Vec<u32>>,
}

impl<'a> Columns<'a> {
    /// About as many columns as triangles.
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let [low, high] = mesh.bounds().map(DVec3::truncate);
        let side = (mesh.triangles.len() as f64).sqrt().ceil().clamp(1.0, 1024.0);
        let cell_m = ((high - low) / side).max(DVec2::splat(f64::MIN_POSITIVE));
        let size = [side as usize; 2];
        let members = vec![Vec::new(); size[0] * size[1]];
        let mut columns = Self { mesh, low, cell_m, size, members };
        for index in 0..mesh.triangles.len() {
            let [a, b, c] = mesh.corners(index).map(DVec3::truncate);
            for column in columns.over(a.min(b).min(c), a.max(b).max(c)) {
                columns.members[column].push(u32::try_from(index).unwrap_or(u32::MAX));
            }
        }
        columns
    }

    fn over(&self, low: DVec2, high: DVec2) -> impl Iterator<Item = usize> + use<> {
        let cell = |p: DVec2, axis: usize| {
            let at = ((p - self.low) / self.cell_m)[axis].floor();
            // Outside and NaN both end at a border cell.
            (at.max(0.0) as usize).min(self.size[axis] - 1)
        };
        let [x0, x1] = [cell(low, 0), cell(high, 0)];
        let [y0, y1] = [cell(low, 1), cell(high, 1)];
        let width = self.size[0];
        (y0..=y1).flat_map(move |y| (x0..=x1).map(move |x| y * width + x))
    }

    /// Triangles whose boxes overlap a box, each once.
    pub(crate) fn near(&self, [low, high]: [DVec3; 2]) -> Vec<usize> {
        let mut found: Vec<usize> = self
            .over(low.truncate(), high.truncate())
            .flat_map(|column| &self.members[column])
            .map(|index| *index as usize)
            .filter(|index| {
                let [a, b, c] = self.mesh.corners(*index);
                a.min(b).min(c).cmple(high).all() && a.max(b).max(c).cmpge(low).all()
            })
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// How often the closed mesh winds around a point: signed crossings of the
    /// line from the point towards +z. A line through an edge or a vertex counts
    /// as if shifted a little along x, and much less along y.
    pub(crate) fn winding(&self, point: DVec3) -> i32 {
        let [low, high] = self.mesh.bounds();
        if !(point.cmpge(low).all() && point.cmple(high).all()) {
            return 0;
        }
        self.over(point.truncate(), point.truncate())
            .flat_map(|column| &self.members[column])
            .map(|index| self.crossing(*index as usize, point))
            .sum()
    }

    /// 1 where the line leaves through the triangle, -1 where it enters.
    fn crossing(&self, triangle: usize, point: DVec3) -> i32 {
        let [a, b, c] = self.mesh.triangles[triangle];
        let sides = [(b, c), (c, a), (a, b)].map(|(from, to)| self.side(from, to, point));
        if sides.iter().any(|(sign, _)| *sign != sides[0].0) {
            return 0;
        }
        let weights = sides.map(|(_, area)| area.abs());
        let total: f64 = weights.iter().sum();
        let heights = self.mesh.corners(triangle).map(|p| p.z);
        let height = (0..3).map(|i| weights[i] / total * heights[i]).sum::<f64>();
        if height > point.z { sides[0].0 } else { 0 }
    }

    /// Side of the directed edge on which the point lies, seen against z: 1 for
    /// left; and twice the area between. Both directions of an edge agree.
    fn side(&self, from: u32, to: u32, point: DVec3) -> (i32, f64) {
        let [low, high] =
            [from.min(to), from.max(to)].map(|v| self.mesh.positions[v as usize].truncate());
        let (along, at) = (high - low, point.truncate() - low);
        let area = along.perp_dot(at);
        let is_left = [area, -along.y, along.x].into_iter().find(|x| *x != 0.0) > Some(0.0);
        let sign = if is_left == (from < to) { 1 } else { -1 };
        (sign, area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::winding;
    use crate::generate::{cuboid, shell, teapot};
    use crate::noise::SplitMix64;

    #[test]
    fn crossings_and_solid_angles_agree() {
        for mesh in [shell(8, 0.6), teapot(8)] {
            let columns = Columns::new(&mesh);
            let [low, high] = mesh.bounds();
            let mut random = SplitMix64(5);
            let mut seen = [0; 4];
            for _ in 0..2_000 {
                let unit = DVec3::from_array([0; 3].map(|_| random.uniform()));
                let p = low + (high - low) * unit;
                let count = columns.winding(p);
                assert!((winding(&mesh, p) - f64::from(count)).abs() < 1e-9, "{p}: {count}");
                seen[count.clamp(0, 3).cast_unsigned() as usize] += 1;
            }
            assert!(seen[0] > 100 && seen[1] > 100 && seen[3] == 0, "{seen:?}");
        }
    }

    /// Lines through edges and vertices of a cube.
    #[test]
    fn lines_through_edges_and_corners_count_once() {
        let mesh = cuboid(DVec3::ONE);
        let columns = Columns::new(&mesh);
        for (x, y) in [(0.0, 0.0), (0.5, 0.5), (-0.25, 0.25), (-1.0, -1.0), (-1.0, 0.0)] {
            assert_eq!(columns.winding(DVec3::new(x, y, 0.0)), 1, "{x} {y}");
        }
        // The shift along x leaves the box here.
        assert_eq!(columns.winding(DVec3::new(1.0, 0.0, 0.0)), 0);
        assert_eq!(columns.winding(DVec3::new(0.0, 0.0, 1.5)), 0);
    }
}
