//! The sun's disc, and how much of a texel it covers.
//!
//! A texel shows the disc by its share of the texel's solid angle, found by
//! halving the texel down to a fraction of the disc's edge, and not by a few
//! samples that a small disc falls between. What a lookup shows of the disc has
//! the disc's own flux within 1e-4, whatever the size of the disc and of the
//! texels (`the_sun_keeps_its_flux` checks this).

use super::texel::Texel;
use glam::DVec3;

/// A disc of constant radiance with an edge as wide as a tenth of its radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector towards the sun.
    pub direction: DVec3,
    /// Angular radius, degrees.
    pub radius_deg: f64,
    /// Linear radiance of the disc, in place of the sky's.
    pub radiance: DVec3,
}

/// Where the edge begins and ends, in radii.
const EDGE: [f64; 2] = [0.95, 1.05];
/// Pieces of a texel on the edge are halved until they are this small, in radii.
const PIECE: f64 = 0.01;

impl Sun {
    /// Irradiance on a surface that faces the sun: radiance times the integral
    /// of the disc's coverage.
    #[must_use]
    pub fn irradiance(&self) -> DVec3 {
        let steps = 4096;
        let width = EDGE[1] * self.radius_deg.to_radians() / f64::from(steps);
        let solid_angle: f64 = (0..steps)
            .map(|i| {
                let angle = (f64::from(i) + 0.5) * width;
                let weight = angle.sin() * angle.cos() * width * std::f64::consts::TAU;
                self.coverage_at(angle) * weight
            })
            .sum();
        self.radiance * solid_angle
    }

    /// How much of the sun's radiance is seen along a unit direction, 0 to 1.
    pub(super) fn coverage(&self, direction: DVec3) -> f64 {
        self.coverage_at(self.angle_to(direction))
    }

    /// How much of the sun's radiance a texel shows, so that lookups between
    /// texels spread the disc's own flux: its share of the texel's solid angle
    /// times the ratio of that solid angle to the weight of the texel in lookups.
    pub(super) fn share_of(&self, texel: &Texel) -> f64 {
        // Most texels are nowhere near.
        let near = EDGE[1] * self.radius_deg.to_radians() + texel.reach();
        if near < std::f64::consts::PI && texel.direction(0.5, 0.5).dot(self.direction) < near.cos()
        {
            return 0.0;
        }
        let covered = self.covered(texel) / texel.solid_angle();
        covered.min(1.0) * texel.area_over_lookup_weight()
    }

    /// Integral of the coverage over the solid angle of a texel or a piece.
    fn covered(&self, piece: &Texel) -> f64 {
        let radius = self.radius_deg.to_radians();
        let [middle, reach] = self.middle_and_reach(piece);
        if middle - reach >= EDGE[1] * radius {
            0.0
        } else if middle + reach <= EDGE[0] * radius {
            piece.solid_angle()
        } else if reach <= PIECE * radius {
            piece.integral(|direction| self.coverage(direction))
        } else {
            piece.halves().iter().map(|half| self.covered(half)).sum()
        }
    }

    /// Angles from the sun to the middle of a piece, and from there to its
    /// farthest corner with some to spare, radians.
    fn middle_and_reach(&self, piece: &Texel) -> [f64; 2] {
        let middle = piece.direction(0.5, 0.5);
        let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)];
        let chords = corners.map(|(x, y)| (piece.direction(x, y) - middle).length_squared());
        [self.angle_to(middle), 1.05 * chords.into_iter().fold(0.0, f64::max).sqrt()]
    }

    fn angle_to(&self, direction: DVec3) -> f64 {
        direction.cross(self.direction).length().atan2(direction.dot(self.direction))
    }

    fn coverage_at(&self, angle: f64) -> f64 {
        let radius = self.radius_deg.to_radians();
        1.0 - smooth_step(EDGE[0] * radius, EDGE[1] * radius, angle)
    }
}

/// 0 below `low`, 1 above `high`, smooth between.
pub(super) fn smooth_step(low: f64, high: f64, value: f64) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
