//! Making the two forms of a directional image: the lat-long original and the
//! cube that both renderers look up.

use super::area_mean::Meridians;
use super::texel::{Chart, Texel};
use super::{Cube, LatLong, Map, Sky};
use glam::{DVec2, DVec3};
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

    /// Fills an image with what each texel shows.
    fn from_texels(size_px: [u32; 2], shows: impl Fn(&Texel) -> DVec3 + Sync) -> Self {
        let [width, height] = size_px.map(|n| n as usize);
        let size = DVec2::new(1.0 / width as f64, 1.0 / height as f64);
        let mut texels = vec![[0.0; 3]; width * height];
        texels.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, texel) in row.iter_mut().enumerate() {
                let low = DVec2::new(x as f64, y as f64) * size;
                *texel = shows(&Texel { chart: Chart::LatLong, low, size }).as_vec3().to_array();
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
        let meridians = Meridians::new(&lat_long, rotation_deg);
        let cube = Cube::from_texels(size, |texel| meridians.mean_over(texel));
        Self { name: name.to_owned(), lat_long, cube, rotation_deg, repaired_texels }
    }

    /// What people must know of it.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let (name, [width, height], repaired) =
            (&self.name, self.lat_long.size_px, self.repaired_texels);
        let stretched = (width != 2 * height).then(|| {
            format!(
                "{name} is {width} x {height} pixels; a lat-long map is twice as wide as high, and \
                 this one is stretched to fit"
            )
        });
        let bad = (repaired > 0).then(|| {
            format!(
                "{name}: {repaired} texels were NaN, infinite or negative and have been repaired"
            )
        });
        stretched.into_iter().chain(bad).collect()
    }

    /// A procedural sky as an environment.
    #[must_use]
    pub fn from_sky(sky: &Sky, rotation_deg: f64, cube_size_px: Option<u32>) -> Self {
        let (unturned, turned) = (sky.turned(0.0), sky.turned(rotation_deg));
        let size = cube_size_px.unwrap_or(SKY_CUBE_PX);
        Self {
            name: "sky".to_owned(),
            lat_long: LatLong::from_texels([2 * size, size], |texel| unturned.mean_over(texel)),
            cube: Cube::from_texels(size, |texel| turned.mean_over(texel)),
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
        LatLong::from_texels([512, 256], |texel| 0.5 + 0.5 * texel.direction(0.5, 0.5))
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
