//! A cube map with a border, so that one bilinear filter is seamless and the
//! same on the CPU and in WGSL.
//!
//! Faces in WebGPU's order +X, -X, +Y, -Y, +Z, -Z and orientation. Each face of
//! size S is stored as (S + 2)² texels; the ring around it repeats the
//! neighbouring faces' texels.

use super::texel::{Chart, Texel, direction_of, face_of};
use glam::{DVec2, DVec3};

/// Six bordered faces of linear radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct Cube {
    /// S: edge of a face without its border, texels.
    pub size_px: u32,
    /// 6 · (S + 2)² texels R, G, B, 1; face by face, rows from the top.
    pub texels: Vec<[f32; 4]>,
}

impl Cube {
    /// Fills a cube from a function of direction, evaluated at texel centres.
    pub fn from_fn(size_px: u32, radiance: impl Fn(DVec3) -> DVec3 + Sync) -> Self {
        Self::from_texels(size_px, |texel| radiance(texel.direction(0.5, 0.5)))
    }

    /// Fills a cube with what each texel shows.
    pub(super) fn from_texels(size_px: u32, shows: impl Fn(&Texel) -> DVec3 + Sync) -> Self {
        use rayon::prelude::*;
        let stride = size_px as usize + 2;
        let size = DVec2::splat(1.0 / f64::from(size_px));
        let mut cube = Self { size_px, texels: vec![[0.0; 4]; 6 * stride * stride] };
        let rows = cube.texels.par_chunks_mut(stride).enumerate();
        rows.for_each(|(row, texels)| {
            let (face, y) = (row / stride, row % stride);
            for (x, texel) in texels.iter_mut().enumerate() {
                let inside = |i: usize| (1..=size_px as usize).contains(&i);
                if inside(x) && inside(y) {
                    let low = DVec2::new(x as f64 - 1.0, y as f64 - 1.0) * size;
                    let shown = shows(&Texel { chart: Chart::Face(face), low, size });
                    *texel = shown.as_vec3().extend(1.0).to_array();
                }
            }
        });
        cube.fill_borders();
        cube
    }

    /// Radiance along a unit direction: bilinear in the face the direction
    /// points at, seamless across edges through the border.
    #[must_use]
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let (face, at) = face_of(direction);
        let size = f64::from(self.size_px);
        let position = (at * size + 0.5).clamp(DVec2::splat(0.5), DVec2::splat(size + 0.5));
        let low = position.floor();
        let f = position - low;
        let texel =
            |dx: usize, dy: usize| self.texel(face, low.x as usize + dx, low.y as usize + dy);
        let top = texel(0, 0).lerp(texel(1, 0), f.x);
        let bottom = texel(0, 1).lerp(texel(1, 1), f.x);
        top.lerp(bottom, f.y)
    }

    fn index(&self, face: usize, x: usize, y: usize) -> usize {
        let stride = self.size_px as usize + 2;
        (face * stride + y) * stride + x
    }

    fn texel(&self, face: usize, x: usize, y: usize) -> DVec3 {
        let [r, g, b, _] = self.texels[self.index(face, x, y)].map(f64::from);
        DVec3::new(r, g, b)
    }

    /// Edges take the nearest texel of the neighbouring face, corners the mean
    /// of the three texels that meet there.
    fn fill_borders(&mut self) {
        let size = self.size_px as usize;
        for face in 0..6 {
            for i in 1..=size {
                for (x, y) in [(0, i), (size + 1, i), (i, 0), (i, size + 1)] {
                    let at = DVec2::new(x as f64 - 0.5, y as f64 - 0.5) / size as f64;
                    let (other, to) = face_of(direction_of(face, at));
                    let [ox, oy] = (to * size as f64).to_array();
                    let clamp = |v: f64| (v.floor() as i64).clamp(0, size as i64 - 1) as usize + 1;
                    let source = self.index(other, clamp(ox), clamp(oy));
                    let target = self.index(face, x, y);
                    self.texels[target] = self.texels[source];
                }
            }
            for (x, y, ix, iy) in [
                (0, 0, 1, 1),
                (size + 1, 0, size, 1),
                (0, size + 1, 1, size),
                (size + 1, size + 1, size, size),
            ] {
                let three = [(ix, iy), (x, iy), (ix, y)].map(|(x, y)| self.texel(face, x, y));
                let mean = (three[0] + three[1] + three[2]) / 3.0;
                let target = self.index(face, x, y);
                self.texels[target] = mean.as_vec3().extend(1.0).to_array();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_and_its_place_on_the_cube_are_each_others_inverse() {
        for face in 0..6 {
            for at in [DVec2::new(0.1, 0.7), DVec2::new(0.5, 0.5), DVec2::new(0.99, 0.01)] {
                let (back_face, back_at) = face_of(direction_of(face, at));
                assert_eq!(face, back_face);
                assert!((at - back_at).length() < 1e-15);
            }
        }
    }

    /// Both faces of an edge give the same value there, whatever the texels.
    #[test]
    fn the_lookup_is_continuous_across_every_edge() {
        let noise = |d: DVec3| DVec3::splat((1e4 * d.dot(DVec3::new(1.0, 2.7, 5.1))).sin());
        let cube = Cube::from_fn(16, noise);
        let nudge = 1e-9;
        for face in 0..6 {
            for i in 0..400 {
                let along = (f64::from(i) + 0.5) / 400.0;
                for edge in [
                    [DVec2::new(along, nudge), DVec2::new(along, -nudge)],
                    [DVec2::new(nudge, along), DVec2::new(-nudge, along)],
                    [DVec2::new(along, 1.0 - nudge), DVec2::new(along, 1.0 + nudge)],
                    [DVec2::new(1.0 - nudge, along), DVec2::new(1.0 + nudge, along)],
                ] {
                    let [inside, beyond] = edge.map(|at| cube.radiance(direction_of(face, at)));
                    assert!((inside - beyond).length() < 1e-6, "face {face} {along}");
                }
            }
        }
        // The check is sharp: a tenth of a texel further the values differ.
        let [a, b] = [0.30, 0.306].map(|x| cube.radiance(direction_of(0, DVec2::new(x, nudge))));
        assert!((a - b).length() > 1e-3);
    }

    /// A cube filled with its own directions returns them, across edges too.
    #[test]
    fn the_lookup_is_seamless() {
        let cube = Cube::from_fn(64, |direction| direction);
        for direction in [
            DVec3::new(1.0, 1.0, 0.2),
            DVec3::new(1.0, 0.999, -0.2),
            DVec3::new(-1.0, -1.0, 1.0),
            DVec3::new(0.3, -0.2, -0.9),
        ] {
            let direction = direction.normalize();
            assert!((cube.radiance(direction) - direction).length() < 0.02, "{direction}");
        }
    }
}
