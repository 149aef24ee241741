//! A texel of an image of directions: which directions it holds, how large its
//! solid angle is, and how much solid angle it answers for in lookups.

use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// How the directions lie in the unit square.
#[derive(Clone, Copy, Debug)]
pub(super) enum Chart {
    /// A face of the cube, by number.
    Face(usize),
    /// Columns are longitudes from -Z towards +X, rows latitudes from +Y.
    LatLong,
}

/// A texel, or a piece of one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Texel {
    pub(super) chart: Chart,
    /// Its upper left corner in the unit square.
    pub(super) low: DVec2,
    /// Its edges there.
    pub(super) size: DVec2,
}

/// Places and weights of Gauss's rule with two points on [0, 1].
pub(super) const GAUSS: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

impl Texel {
    /// Unit direction of a place in it, from (0, 0) to (1, 1).
    pub(super) fn direction(&self, x: f64, y: f64) -> DVec3 {
        let at = self.low + self.size * DVec2::new(x, y);
        match self.chart {
            Chart::Face(face) => direction_of(face, at),
            Chart::LatLong => {
                let (sin_phi, cos_phi) = (at.x * TAU).sin_cos();
                let (sin, cos) = (at.y * PI).sin_cos();
                DVec3::new(sin * sin_phi, cos, -sin * cos_phi)
            }
        }
    }

    /// Radians within which all of it lies around its middle.
    pub(super) fn reach(&self) -> f64 {
        match self.chart {
            Chart::Face(_) => self.size.length(),
            Chart::LatLong => 0.5 * (self.size * DVec2::new(TAU, PI)).length(),
        }
    }

    /// Steradians.
    pub(super) fn solid_angle(&self) -> f64 {
        let (low, high) = (self.low, self.low + self.size);
        match self.chart {
            Chart::Face(_) => {
                // Of the rectangle from the middle of the face to a corner.
                let corner = |x: f64, y: f64| {
                    let (u, v) = (2.0 * x - 1.0, 2.0 * y - 1.0);
                    (u * v).atan2((1.0 + u * u + v * v).sqrt())
                };
                corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y)
                    + corner(low.x, low.y)
            }
            Chart::LatLong => {
                let middle = 0.5 * PI * (low.y + high.y);
                TAU * self.size.x * 2.0 * middle.sin() * (0.5 * PI * self.size.y).sin()
            }
        }
    }

    /// Integral of a function of direction over its solid angle, by Gauss's rule
    /// with 2 x 2 points.
    pub(super) fn integral(&self, value: impl Fn(DVec3) -> f64) -> f64 {
        let places = GAUSS.iter().flat_map(|x| GAUSS.map(|y| (*x, y)));
        let at = |(x, y)| {
            value(self.direction(x, y)) * self.density(self.low + self.size * DVec2::new(x, y))
        };
        0.25 * self.size.element_product() * places.map(at).sum::<f64>()
    }

    /// Its two halves, cut across its longer side: texels beside a pole are narrow.
    pub(super) fn halves(&self) -> [Self; 2] {
        let across = self.direction(0.0, 0.5).distance_squared(self.direction(1.0, 0.5));
        let along = self.direction(0.5, 0.0).distance_squared(self.direction(0.5, 1.0));
        let cut = if across > along { DVec2::new(0.5, 0.0) } else { DVec2::new(0.0, 0.5) };
        let size = self.size * (1.0 - cut);
        [self.low, self.low + self.size * cut].map(|low| Self { low, size, ..*self })
    }

    /// Its solid angle over the weight that it has in bilinear lookups in all
    /// directions together. They differ because solid angle per area varies over
    /// the image: by 4e-3 at 16 texels a face and a 1/1024 of that at 512, but by
    /// 8e-2 in the row around a pole of any lat-long image.
    ///
    /// Beyond an edge the neighbouring face, or the other side of the pole,
    /// continues like a mirror image.
    pub(super) fn area_over_lookup_weight(&self) -> f64 {
        let middle = self.low + 0.5 * self.size;
        let mut weight = 0.0;
        for x in STEPS.iter().flat_map(|step| GAUSS.map(|g| step + 0.5 * g)) {
            for y in STEPS.iter().flat_map(|step| GAUSS.map(|g| step + 0.5 * g)) {
                let tents = (1.0 - x.abs()) * (1.0 - y.abs());
                let at = mirrored(middle + self.size * DVec2::new(x, y));
                weight += tents * self.density(at) / 16.0;
            }
        }
        self.solid_angle() / (weight * self.size.element_product())
    }

    /// Steradians per unit of area at a place in the unit square.
    fn density(&self, at: DVec2) -> f64 {
        match self.chart {
            Chart::Face(_) => {
                let q = 1.0 + (2.0 * at - 1.0).length_squared();
                4.0 / (q * q.sqrt())
            }
            Chart::LatLong => TAU * PI * (PI * at.y).sin(),
        }
    }
}

/// Begins of half texels around a texel's middle: a tent is smooth in each, and
/// an image ends between two.
const STEPS: [f64; 4] = [-1.0, -0.5, 0.0, 0.5];

fn mirrored(at: DVec2) -> DVec2 {
    let fold = |v: f64| if v < 0.0 { -v } else { v.min(2.0 - v) };
    DVec2::new(fold(at.x), fold(at.y))
}

/// Face a direction points at and the position on it in [0, 1]², y downwards.
#[must_use]
pub fn face_of(direction: DVec3) -> (usize, DVec2) {
    let DVec3 { x, y, z } = direction;
    let [ax, ay, az] = direction.abs().to_array();
    let (face, u, v, major) = if ax >= ay && ax >= az {
        if x >= 0.0 { (0, -z, -y, ax) } else { (1, z, -y, ax) }
    } else if ay >= az {
        if y >= 0.0 { (2, x, z, ay) } else { (3, x, -z, ay) }
    } else if z >= 0.0 {
        (4, x, -y, az)
    } else {
        (5, -x, -y, az)
    };
    (face, 0.5 * (DVec2::new(u, v) / major + 1.0))
}

/// Unit direction through a position of a face; positions outside [0, 1]² give
/// directions beyond the face's edge.
#[must_use]
pub fn direction_of(face: usize, at: DVec2) -> DVec3 {
    let [u, v] = (2.0 * at - 1.0).to_array();
    let direction = match face {
        0 => DVec3::new(1.0, -v, -u),
        1 => DVec3::new(-1.0, -v, u),
        2 => DVec3::new(u, 1.0, v),
        3 => DVec3::new(u, -1.0, -v),
        4 => DVec3::new(u, -v, 1.0),
        _ => DVec3::new(-u, -v, -1.0),
    };
    direction.normalize()
}
