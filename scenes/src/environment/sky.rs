//! A procedural sky: a gradient, a ground, a sun, and lines that make bending
//! visible. No file is needed, and every value is known exactly.

use super::sun::{Sun, smooth_step};
use super::texel::Texel;
use glam::{DQuat, DVec3};

/// Light from every direction, as a formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Linear radiance straight up.
    pub zenith: DVec3,
    /// Linear radiance at the horizon.
    pub horizon: DVec3,
    /// Linear radiance straight down.
    pub ground: DVec3,
    /// A disc of light.
    pub sun: Option<Sun>,
    /// Squares on the ground.
    pub checker: Option<Checker>,
    /// Lines of equal azimuth and elevation.
    pub graticule: Option<Graticule>,
}

/// Squares on a plane below the eye; they fade towards the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// Linear radiance of every other square; the rest keeps the ground's.
    pub colour: DVec3,
    /// Edge of a square in units of the plane's depth below the eye.
    pub size: f64,
}

/// Lines on the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Graticule {
    /// Linear radiance of the lines.
    pub colour: DVec3,
    /// Angle between lines, degrees; divides 90.
    pub every_deg: f64,
    /// Width of a line, degrees.
    pub width_deg: f64,
}

impl Sky {
    /// Linear radiance seen along a unit direction.
    #[must_use]
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let radiance = self.without_sun(direction);
        match self.sun {
            Some(sun) => radiance.lerp(sun.radiance, sun.coverage(direction)),
            None => radiance,
        }
    }

    /// The sky turned about +Y: what was at -Z moves towards +X.
    pub(super) fn turned(&self, degrees: f64) -> TurnedSky<'_> {
        let back = DQuat::from_rotation_y(degrees.to_radians());
        let turn = |sun: Sun| Sun { direction: back.inverse() * sun.direction, ..sun };
        TurnedSky { sky: self, sun: self.sun.map(turn), back }
    }

    /// True where nothing but the sun changes within a few texels: away from
    /// the ground and the lines.
    fn is_smooth(&self, direction: DVec3) -> bool {
        direction.y > 0.05 && self.graticule.is_none()
    }

    fn without_sun(&self, direction: DVec3) -> DVec3 {
        let radiance = self.background(direction);
        match self.graticule {
            Some(lines) => radiance.lerp(lines.colour, lines.coverage(direction)),
            None => radiance,
        }
    }

    fn background(&self, direction: DVec3) -> DVec3 {
        let up = direction.y.clamp(-1.0, 1.0);
        if up >= 0.0 {
            return self.horizon.lerp(self.zenith, up.powf(0.6));
        }
        let ground = match self.checker {
            Some(checker) => self.ground.lerp(checker.colour, checker.coverage(direction)),
            None => self.ground,
        };
        self.horizon.lerp(ground, smooth_step(0.0, 0.12, -up))
    }
}

/// A sky in another orientation.
pub(super) struct TurnedSky<'a> {
    sky: &'a Sky,
    /// The sky's own, turned as well.
    sun: Option<Sun>,
    back: DQuat,
}

impl TurnedSky<'_> {
    /// What a texel shows: the sun by its exact share of it, the rest by the
    /// mean of 2 x 2 places, or the value in the middle where it is smooth.
    pub(super) fn mean_over(&self, texel: &Texel) -> DVec3 {
        let at = |x, y| self.back * texel.direction(x, y);
        let middle = at(0.5, 0.5);
        let radiance = if self.sky.is_smooth(middle) {
            self.sky.without_sun(middle)
        } else {
            let places = [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)];
            0.25 * places.map(|(x, y)| self.sky.without_sun(at(x, y))).iter().sum::<DVec3>()
        };
        match self.sun {
            Some(sun) => radiance + sun.share_of(texel) * (sun.radiance - radiance),
            None => radiance,
        }
    }
}

impl Checker {
    /// 0 to 1: how much of the second colour; squares with soft edges that grow
    /// with their distance, so that far ones blend into their mean.
    fn coverage(&self, direction: DVec3) -> f64 {
        let depth = (-direction.y).max(1e-3);
        let [x, z] = [direction.x, direction.z].map(|v| v / depth / self.size);
        // One degree on the ground, in squares: grows with the slant squared.
        let blur = 0.012 / (depth * depth * self.size);
        let wave = |v: f64| {
            let triangle = 4.0 * ((0.5 * v - (0.5 * v).floor()) - 0.5).abs() - 1.0;
            (triangle / (2.0 * blur).max(1e-6)).clamp(-1.0, 1.0)
        };
        0.5 + 0.5 * wave(x - 0.5) * wave(z - 0.5) * (-2.0 * blur * blur).exp()
    }
}

impl Graticule {
    fn coverage(&self, direction: DVec3) -> f64 {
        let elevation = direction.y.clamp(-1.0, 1.0).asin();
        let azimuth = direction.x.atan2(-direction.z);
        let line = |angle_rad: f64, stretch: f64| {
            let turns = angle_rad.to_degrees() / self.every_deg;
            let distance_deg = (turns - turns.round()).abs() * self.every_deg * stretch;
            let half = 0.5 * self.width_deg;
            1.0 - smooth_step(0.8 * half, 1.2 * half, distance_deg)
        };
        // Meridians keep their width in angle and end before they crowd the pole.
        let meridian = if direction.y.abs() < 0.985 { line(azimuth, elevation.cos()) } else { 0.0 };
        line(elevation, 1.0).max(meridian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sky() -> Sky {
        Sky {
            zenith: DVec3::new(0.2, 0.4, 0.9),
            horizon: DVec3::splat(0.8),
            ground: DVec3::splat(0.1),
            sun: Some(Sun { direction: DVec3::X, radius_deg: 2.0, radiance: DVec3::splat(500.0) }),
            checker: Some(Checker { colour: DVec3::splat(0.5), size: 0.5 }),
            graticule: None,
        }
    }

    #[test]
    fn the_sky_shows_what_it_was_given() {
        let sky = sky();
        assert_eq!(sky.radiance(DVec3::Y), sky.zenith);
        assert_eq!(sky.radiance(DVec3::X), DVec3::splat(500.0));
        assert_eq!(sky.radiance(DVec3::NEG_Z), sky.horizon);
    }
}
