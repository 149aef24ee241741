//! Making the two forms of a directional image: the lat-long original and the
//! cube that both renderers look up.

use super::{Cube, LatLong, Map, Sky};
use glam::DVec3;
use rayon::prelude::*;

/// Edge of the cube faces of a procedural sky, texels.
const SKY_CUBE_PX: u32 = 512;

/// What to do with values that are no radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repair {
    /// Keep finite negative values; by default they become zero.
    pub keep_negative: bool,
}

impl LatLong {
    /// Replaces NaN by 0, +Inf by the largest finite value of the image, -Inf
    /// by 0 and, unless they are kept, negative values by 0. Returns how many
    /// texels changed.
    pub fn repair(&mut self, repair: Repair) -> u64 {
        let finite = self.texels.iter().flatten().filter(|v| v.is_finite());
        let largest = finite.fold(0.0f32, |a, b| a.max(*b));
        let mut repaired = 0;
        for texel in &mut self.texels {
            let sound = texel.map(|value| match value {
                v if v.is_nan() || v == f32::NEG_INFINITY => 0.0,
                v if v == f32::INFINITY => largest,
                v if v < 0.0 && !repair.keep_negative => 0.0,
                v => v,
            });
            repaired += u64::from(sound.map(f32::to_bits) != texel.map(f32::to_bits));
            *texel = sound;
        }
        repaired
    }

    /// Fills an image from a function of direction: mean of 2 x 2 places per
    /// texel, or the value at the centre where the function is smooth.
    fn from_fn(
        size_px: [u32; 2],
        radiance: impl Fn(DVec3) -> DVec3 + Sync,
        is_smooth: impl Fn(DVec3) -> bool + Sync,
    ) -> Self {
        let [width, height] = size_px.map(|n| n as usize);
        let mut texels = vec![[0.0; 3]; width * height];
        texels.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, texel) in row.iter_mut().enumerate() {
                let at = |dx: f64, dy: f64| {
                    let phi = (x as f64 + dx) / width as f64 * std::f64::consts::TAU;
                    let theta = (y as f64 + dy) / height as f64 * std::f64::consts::PI;
                    let ((sin_phi, cos_phi), (sin, cos)) = (phi.sin_cos(), theta.sin_cos());
                    DVec3::new(sin * sin_phi, cos, -sin * cos_phi)
                };
                let centre = at(0.5, 0.5);
                let mean = if is_smooth(centre) {
                    radiance(centre)
                } else {
                    let places = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)];
                    0.25 * places.map(|(dx, dy)| radiance(at(dx, dy))).iter().sum::<DVec3>()
                };
                *texel = mean.as_vec3().to_array();
            }
        });
        Self { size_px, texels }
    }
}

impl Map {
    /// A lat-long image as an environment. `cube_size_px`: edge of the cube's
    /// faces; by default the power of two nearest to a quarter of the width,
    /// from 64 to 2048.
    #[must_use]
    pub fn from_lat_long(
        name: &str,
        mut lat_long: LatLong,
        rotation_deg: f64,
        cube_size_px: Option<u32>,
        repair: Repair,
    ) -> Self {
        let repaired_texels = lat_long.repair(repair);
        let size = cube_size_px.unwrap_or_else(|| default_cube_size(lat_long.size_px[0]));
        let cube = Cube::averaged(size, |d| lat_long.radiance(d, rotation_deg), |_| false);
        Self { name: name.to_owned(), lat_long, cube, rotation_deg, repaired_texels }
    }

    /// A procedural sky as an environment.
    #[must_use]
    pub fn from_sky(sky: &Sky, rotation_deg: f64, cube_size_px: Option<u32>) -> Self {
        let turned = sky.turned(rotation_deg);
        let size = cube_size_px.unwrap_or(SKY_CUBE_PX);
        Self {
            name: "sky".to_owned(),
            lat_long: LatLong::from_fn([2 * size, size], |d| sky.radiance(d), |d| sky.is_smooth(d)),
            cube: Cube::averaged(size, |d| turned.radiance(d), |d| turned.is_smooth(d)),
            rotation_deg,
            repaired_texels: 0,
        }
    }
}

fn default_cube_size(width_px: u32) -> u32 {
    let exponent = (f64::from(width_px.max(1)) / 4.0).log2().round().clamp(6.0, 11.0);
    1 << exponent as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The image whose colours are its directions: 0.5 + 0.5 d.
    fn axes() -> LatLong {
        LatLong::from_fn([512, 256], |d| DVec3::splat(0.5) + 0.5 * d, |_| false)
    }

    #[test]
    fn both_lookups_agree_on_where_every_direction_is() {
        let map = Map::from_lat_long("axes", axes(), 0.0, None, Repair::default());
        assert_eq!(map.cube.size_px, 128);
        for i in 0..200 {
            let t = f64::from(i);
            let d = DVec3::new((1.7 * t).sin(), (0.61 * t).cos() * 0.98, (2.9 * t + 1.0).sin());
            let d = d.normalize();
            let expected = DVec3::splat(0.5) + 0.5 * d;
            assert!((map.cube.radiance(d) - expected).length() < 2e-3, "cube {d}");
            let lat_long = map.lat_long.radiance(d, 0.0);
            assert!((lat_long - expected).length() < 5e-3, "lat-long {d} {lat_long}");
        }
    }

    #[test]
    fn a_mirrored_or_turned_image_is_noticed() {
        let mut mirrored = axes();
        for row in mirrored.texels.chunks_mut(512) {
            row.reverse();
        }
        let map = Map::from_lat_long("mirrored", mirrored, 0.0, None, Repair::default());
        assert!((map.cube.radiance(DVec3::X) - DVec3::new(1.0, 0.5, 0.5)).length() > 0.9);
        let turned = Map::from_lat_long("turned", axes(), 90.0, None, Repair::default());
        // What was at -Z is now at +X.
        assert!((turned.cube.radiance(DVec3::X) - DVec3::new(0.5, 0.5, 0.0)).length() < 5e-3);
    }

    #[test]
    fn bad_texels_are_repaired_and_counted() {
        let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -3.0, 7.0, 0.0];
        let texels = bad.map(|v| [v, 1.0, 1.0]).to_vec();
        let mut map = LatLong { size_px: [6, 1], texels };
        let mut kept = map.clone();
        assert_eq!(map.repair(Repair::default()), 4);
        let reds: Vec<f32> = map.texels.iter().map(|texel| texel[0]).collect();
        assert_eq!(reds, [0.0, 7.0, 0.0, 0.0, 7.0, 0.0]);
        assert_eq!(kept.repair(Repair { keep_negative: true }), 3);
        assert_eq!(kept.texels[3][0], -3.0);
    }

    #[test]
    fn faces_are_powers_of_two_near_a_quarter_of_the_width() {
        let sizes = [1, 512, 1024, 1500, 8192, 100_000].map(default_cube_size);
        assert_eq!(sizes, [64, 128, 256, 512, 2048, 2048]);
    }
}
