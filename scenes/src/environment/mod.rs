//! Light from infinity: one object that both renderers look up alike.
//!
//! Whatever the source (a constant, a lat-long map, a procedural sky), the
//! renderers see the same decoded f32 texels of one [`Cube`]. The lat-long
//! original stays available for agreement with other renderers.

mod area_mean;
#[cfg(test)]
mod area_mean_tests;
mod cube;
mod map;
mod sky;
mod sun;
#[cfg(test)]
mod sun_tests;
mod texel;

pub use cube::Cube;
pub use map::Repair;
pub use sky::{Checker, Graticule, Sky};
pub use sun::Sun;
pub use texel::{direction_of, face_of};

use glam::DVec3;
use std::sync::Arc;

/// What surrounds the scene.
#[derive(Clone, Debug)]
pub enum Environment {
    /// The same radiance from everywhere: nothing is looked up.
    Uniform(DVec3),
    /// An image of directions.
    Map(Arc<Map>),
}

/// A directional image, rotated already.
#[derive(Clone, Debug)]
pub struct Map {
    /// Where it came from: a file name, or `sky`.
    pub name: String,
    /// The original, lat-long.
    pub lat_long: LatLong,
    /// The texels both renderers use by default.
    pub cube: Cube,
    /// Turn about the vertical that both lookups apply to the original,
    /// degrees: what was at -Z moves towards +X.
    pub rotation_deg: f64,
    /// Texels that were NaN, infinite or (if asked) negative and were repaired.
    pub repaired_texels: u64,
}

/// Lat-long image: row 0 at the zenith (+Y); u = 0 is -Z, 0.25 is +X.
#[derive(Clone, Debug, PartialEq)]
pub struct LatLong {
    /// Width and height, texels.
    pub size_px: [u32; 2],
    /// Linear R, G, B, rows from the top.
    pub texels: Vec<[f32; 3]>,
}

impl Environment {
    /// Radiance seen along a unit world direction, from the cube.
    #[must_use]
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        match self {
            Self::Uniform(radiance) => *radiance,
            Self::Map(map) => map.cube.radiance(direction),
        }
    }

    /// Radiance from the lat-long original.
    #[must_use]
    pub fn radiance_lat_long(&self, direction: DVec3) -> DVec3 {
        match self {
            Self::Uniform(radiance) => *radiance,
            Self::Map(map) => map.lat_long.radiance(direction, map.rotation_deg),
        }
    }
}

impl LatLong {
    /// Bilinear lookup: columns texel-centred and periodic, rows texel-centred
    /// and clamped. phi = atan2(x, -z), theta = acos(y).
    #[must_use]
    pub fn radiance(&self, direction: DVec3, rotation_deg: f64) -> DVec3 {
        let [width, height] = self.size_px.map(|n| n as usize);
        let turns = direction.x.atan2(-direction.z) / std::f64::consts::TAU - rotation_deg / 360.0;
        let u = (turns - turns.floor()) * width as f64 - 0.5;
        let v = direction.y.clamp(-1.0, 1.0).acos() / std::f64::consts::PI * height as f64 - 0.5;
        let (column, row) = (u.floor(), v.floor());
        let (fx, fy) = (u - column, v - row);
        let texel = |dx: i64, dy: i64| {
            let x = (column as i64 + dx).rem_euclid(width as i64) as usize;
            let y = (row as i64 + dy).clamp(0, height as i64 - 1) as usize;
            DVec3::from_array(self.texels[y * width + x].map(f64::from))
        };
        let top = texel(0, 0).lerp(texel(1, 0), fx);
        let bottom = texel(0, 1).lerp(texel(1, 1), fx);
        top.lerp(bottom, fy)
    }
}
