//! A procedural sky: a gradient, a ground, a sun, and lines that make bending
//! visible. No file is needed, and every value is known exactly.

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
        let mut radiance = self.background(direction);
        if let Some(lines) = self.graticule {
            radiance = radiance.lerp(lines.colour, lines.coverage(direction));
        }
        match self.sun {
            Some(sun) => radiance.lerp(sun.radiance, sun.coverage(direction)),
            None => radiance,
        }
    }

    /// True where nothing changes within a few texels: away from the ground,
    /// the lines and the sun's edge.
    #[must_use]
    pub fn is_smooth(&self, direction: DVec3) -> bool {
        let near_sun = self.sun.is_some_and(|sun| {
            direction.dot(sun.direction) > (2.0 + 1.2 * sun.radius_deg).to_radians().cos()
        });
        direction.y > 0.05 && self.graticule.is_none() && !near_sun
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

    /// The sky turned about +Y: what was at -Z moves towards +X.
    #[must_use]
    pub fn turned(&self, degrees: f64) -> TurnedSky<'_> {
        TurnedSky { sky: self, back: DQuat::from_rotation_y(degrees.to_radians()) }
    }
}

/// A sky in another orientation.
#[derive(Clone, Copy, Debug)]
pub struct TurnedSky<'a> {
    sky: &'a Sky,
    back: DQuat,
}

impl TurnedSky<'_> {
    /// Linear radiance seen along a unit direction.
    #[must_use]
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        self.sky.radiance(self.back * direction)
    }

    /// As [`Sky::is_smooth`].
    #[must_use]
    pub fn is_smooth(&self, direction: DVec3) -> bool {
        self.sky.is_smooth(self.back * direction)
    }
}

impl Sun {
    /// Irradiance on a surface that faces the sun: radiance times the integral
    /// of the disc's coverage.
    #[must_use]
    pub fn irradiance(&self) -> DVec3 {
        let steps = 4096;
        let outer = (1.05 * self.radius_deg).to_radians();
        let width = outer / f64::from(steps);
        let solid_angle: f64 = (0..steps)
            .map(|i| {
                let angle = (f64::from(i) + 0.5) * width;
                let weight = angle.sin() * angle.cos() * width * std::f64::consts::TAU;
                self.coverage_at(angle) * weight
            })
            .sum();
        self.radiance * solid_angle
    }

    fn coverage(&self, direction: DVec3) -> f64 {
        // Most directions are nowhere near: 1 - x²/2 is below cos x.
        let outer = (1.05 * self.radius_deg).to_radians();
        if direction.dot(self.direction) < 1.0 - 0.5 * outer * outer - 1e-9 {
            return 0.0;
        }
        let angle = direction.cross(self.direction).length().atan2(direction.dot(self.direction));
        self.coverage_at(angle)
    }

    fn coverage_at(&self, angle: f64) -> f64 {
        let radius = self.radius_deg.to_radians();
        1.0 - smooth_step(0.95 * radius, 1.05 * radius, angle)
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

fn smooth_step(low: f64, high: f64, value: f64) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
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

    /// A small disc of radius r has the solid angle π sin² r, weighted by the
    /// cosine; the soft edge changes it by less than a per cent.
    #[test]
    fn the_suns_irradiance_is_radiance_times_projected_solid_angle() {
        let sun = sky().sun.unwrap();
        let sharp = 500.0 * std::f64::consts::PI * 2.0f64.to_radians().sin().powi(2);
        assert!((sun.irradiance().x / sharp - 1.0).abs() < 0.01);
    }

    #[test]
    fn turning_moves_the_north_towards_the_east() {
        let sky = Sky { checker: None, ..sky() };
        let turned = sky.turned(90.0);
        // The sun stood at +X; a quarter turn further it stands at +Z.
        assert!(turned.radiance(DVec3::Z).x > 499.0);
        assert!(turned.radiance(DVec3::X).x < 1.0);
    }
}
