//! `sky = { … }` as it is written.

use super::number::{Angle, Direction, DiscRadius, Length, Light, Number};
use crate::environment::{Checker, Graticule, Sky, Sun};
use glam::DVec3;
use serde::Deserialize;

/// Every key is optional: `sky = {}` is a clear day without a sun.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SkyText {
    zenith: Option<Light>,
    horizon: Option<Light>,
    ground: Option<Light>,
    sun: Option<SunText>,
    checker: Option<GroundCheckerText>,
    graticule: Option<GraticuleText>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct SunText {
    direction: Direction,
    radius_deg: DiscRadius,
    radiance: Light,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct GroundCheckerText {
    colour: Light,
    size: Length,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct GraticuleText {
    colour: Light,
    every_deg: Divisor,
    width_deg: Angle,
}

/// An angle that divides the quarter circle.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "Number")]
struct Divisor(f64);

impl TryFrom<Number> for Divisor {
    type Error = String;

    fn try_from(Number(value): Number) -> Result<Self, String> {
        let parts = 90.0 / value;
        let accepted = value >= 1.0 && (parts - parts.round()).abs() < 1e-9 && parts >= 1.0;
        accepted
            .then_some(Self(value))
            .ok_or_else(|| format!("{value} is no whole part of 90 degrees; write such as 10.0"))
    }
}

impl SkyText {
    /// The sky with every default filled in.
    pub(super) fn sky(&self) -> Sky {
        let or = |light: Option<Light>, default: [f64; 3]| {
            light.map_or(DVec3::from_array(default), |light| light.0)
        };
        Sky {
            zenith: or(self.zenith, [0.18, 0.36, 0.80]),
            horizon: or(self.horizon, [0.85, 0.90, 0.95]),
            ground: or(self.ground, [0.22, 0.19, 0.16]),
            sun: self.sun.map(|sun| Sun {
                direction: sun.direction.0,
                radius_deg: sun.radius_deg.0,
                radiance: sun.radiance.0,
            }),
            checker: self
                .checker
                .map(|checker| Checker { colour: checker.colour.0, size: checker.size.0 }),
            graticule: self.graticule.map(|lines| Graticule {
                colour: lines.colour.0,
                every_deg: lines.every_deg.0,
                width_deg: lines.width_deg.0.abs().clamp(0.01, lines.every_deg.0),
            }),
        }
    }
}
