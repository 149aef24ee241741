//! Means of a lat-long image over the texels of a cube.
//!
//! A meridian crosses a texel of the cube in one interval of latitude, whose ends
//! have a closed form; along it the image is linear from row to row, so that its
//! integral has one, too. Over longitudes, between the image's columns and the
//! texel's corners, Gauss's rule is left: where neighbouring texels differ by 1,
//! a mean is off by less than 3e-3, and each texel of the image, however bright,
//! gives its light to the cube within 1e-4, however few texels that has.

use super::LatLong;
use super::texel::{Chart, GAUSS, Texel};
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// An image that is integrated along meridians.
pub(super) struct Meridians<'a> {
    image: &'a LatLong,
    /// Turn about +Y, radians: what was at -Z moves towards +X.
    rotation: f64,
    /// The middle of each row.
    rows: Vec<Polar>,
}

/// An angle from +Y, radians, with its sine and cosine.
#[derive(Clone, Copy)]
struct Polar {
    angle: f64,
    sin: f64,
    cos: f64,
}

/// How a face's texels lie to the meridians. Side faces stand along them;
/// on the other two the meridians are rays from the middle.
enum Bounds {
    /// Longitudes of the face's middle and of the texel's sides, and v of its
    /// upper and lower edge.
    Side { middle: f64, longitudes: [f64; 2], v: [f64; 2] },
    /// Two corners in the plane (towards +X, towards -Z), and whether it is on
    /// the lower face.
    Cap { low: DVec2, high: DVec2, lower: bool },
}

impl<'a> Meridians<'a> {
    pub(super) fn new(image: &'a LatLong, rotation_deg: f64) -> Self {
        let height = image.size_px[1];
        let middle = |row| (f64::from(row) + 0.5) * PI / f64::from(height);
        let polar = |angle: f64| Polar { angle, sin: angle.sin(), cos: angle.cos() };
        let rows = (0..height).map(|row| polar(middle(row))).collect();
        Self { image, rotation: rotation_deg.to_radians(), rows }
    }

    /// Mean over a texel of a cube's face.
    pub(super) fn mean_over(&self, texel: &Texel) -> DVec3 {
        let bounds = Bounds::new(texel);
        let columns = f64::from(self.image.size_px[0]);
        let (mut light, mut solid_angle) = (DVec3::ZERO, 0.0);
        let (longitudes, count) = bounds.longitudes();
        for span in longitudes[..count].windows(2) {
            // Where columns' middles lie, counted from the turned image's left edge.
            let column = |longitude: f64| (longitude - self.rotation) / TAU * columns - 0.5;
            let (first, last) = (column(span[0]), column(span[1]));
            let mut from = first;
            while from < last {
                let to = (from.floor() + 1.0).min(last);
                for place in GAUSS {
                    let at = from + place * (to - from);
                    let longitude = (at + 0.5) / columns * TAU + self.rotation;
                    let ends = bounds.ends(longitude);
                    let width = 0.5 * (to - from) / columns * TAU;
                    light += width * self.along_meridian(at, ends);
                    solid_angle += width * (ends[0].cos - ends[1].cos);
                }
                from = to;
            }
        }
        light / solid_angle
    }

    /// Integral of radiance times the sine of the polar angle between two places on
    /// a meridian between columns' middles.
    fn along_meridian(&self, column: f64, [top, bottom]: [Polar; 2]) -> DVec3 {
        let [width, height] = self.image.size_px.map(|n| n as usize);
        let step = PI / height as f64;
        let (left, share) = (column.floor(), column - column.floor());
        let left = (left as i64).rem_euclid(width as i64) as usize;
        let columns = [left, (left + 1) % width];
        let texel = |row: i64| {
            let row = row.clamp(0, height as i64 - 1) as usize * width;
            let [a, b] = columns.map(|x| self.image.texels[row + x]);
            DVec3::from_array(a.map(f64::from)).lerp(DVec3::from_array(b.map(f64::from)), share)
        };
        let row_at = |polar: Polar| (polar.angle / step - 0.5).floor() as i64;
        let (first, last) = (row_at(top), row_at(bottom));
        let mut sum = DVec3::ZERO;
        let (mut from, mut above) = (top, texel(first));
        for row in first..=last {
            let to = if row == last { bottom } else { self.rows[(row + 1) as usize] };
            // Integrals of sin θ and of (θ - middle of the row above) sin θ.
            let middle = (row as f64 + 0.5) * step;
            let all = from.cos - to.cos;
            let risen =
                (from.angle - middle) * from.cos - (to.angle - middle) * to.cos + to.sin - from.sin;
            let below = texel(row + 1);
            sum += above * (all - risen / step) + below * (risen / step);
            (from, above) = (to, below);
        }
        sum
    }
}

impl Bounds {
    fn new(texel: &Texel) -> Self {
        let (low, high) = (2.0 * texel.low - 1.0, 2.0 * (texel.low + texel.size) - 1.0);
        let side = |middle: f64| {
            let longitudes = [middle - high.x.atan(), middle - low.x.atan()];
            Self::Side { middle, longitudes, v: [low.y, high.y] }
        };
        match texel.chart {
            Chart::Face(0) => side(FRAC_PI_2),
            Chart::Face(1) => side(-FRAC_PI_2),
            Chart::Face(2) => {
                let (low, high) = (DVec2::new(low.x, -high.y), DVec2::new(high.x, -low.y));
                Self::Cap { low, high, lower: false }
            }
            Chart::Face(3) => Self::Cap { low, high, lower: true },
            Chart::Face(4) => side(PI),
            _ => side(0.0),
        }
    }

    /// Longitudes between which the ends of meridians vary smoothly, rising, and
    /// how many.
    fn longitudes(&self) -> ([f64; 6], usize) {
        let (low, high) = match self {
            Self::Side { longitudes: [west, east], .. } => {
                return ([*west, *east, 0.0, 0.0, 0.0, 0.0], 2);
            }
            Self::Cap { low, high, .. } => (*low, *high),
        };
        let around = low.max_element() < 0.0 && high.min_element() > 0.0;
        let middle = if around { DVec2::Y } else { 0.5 * (low + high) };
        // From the middle's longitude, so that none jumps by a turn.
        let turn = |corner: DVec2| -middle.perp_dot(corner).atan2(middle.dot(corner));
        let (mut turns, mut count) = ([0.0; 6], 0);
        for corner in [low, DVec2::new(low.x, high.y), DVec2::new(high.x, low.y), high] {
            // The pole has no longitude.
            if corner != DVec2::ZERO {
                turns[count] = turn(corner);
                count += 1;
            }
        }
        if around {
            turns[count..].copy_from_slice(&[-PI, PI]);
            count += 2;
        }
        turns[..count].sort_unstable_by(f64::total_cmp);
        (turns.map(|turn| middle.x.atan2(middle.y) + turn), count)
    }

    /// Where a meridian enters and leaves, from the upper pole on.
    fn ends(&self, longitude: f64) -> [Polar; 2] {
        // Of a direction so far up and so far out.
        let polar = |up: f64, out: f64| {
            let length = up.hypot(out);
            Polar { angle: out.atan2(up), sin: out / length, cos: up / length }
        };
        match self {
            Self::Side { middle, v, .. } => {
                let cos = (longitude - middle).cos();
                v.map(|v| polar(-v * cos, 1.0))
            }
            Self::Cap { low, high, lower } => {
                let ray = DVec2::new(longitude.sin(), longitude.cos());
                let (a, b) = (*low / ray, *high / ray);
                // Along an axis a side is met nowhere, or everywhere.
                let enters = a.min(b).max_element().max(0.0);
                let leaves = a.max(b).min_element().max(enters);
                match lower {
                    false => [polar(1.0, enters), polar(1.0, leaves)],
                    true => [polar(-1.0, leaves), polar(-1.0, enters)],
                }
            }
        }
    }
}
