//! Numbers of scene files, checked where they are read, so that a bad one is
//! reported with its own line and column.

use glam::DVec3;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use std::fmt;

/// Lengths and positions beyond this many metres are typing errors.
const LARGEST_M: f64 = 1e12;
/// Radiances, irradiances and intensities beyond this are typing errors.
const BRIGHTEST: f64 = 1e30;

/// A finite number; whole numbers need no decimal point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Number(pub(super) f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumberVisitor;
        impl Visitor<'_> for NumberVisitor {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number such as 1.0")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Number, E> {
                let finite = value.is_finite().then_some(Number(value));
                finite.ok_or_else(|| E::custom(format!("{value} is not finite; write such as 1.0")))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Number, E> {
                Ok(Number(value as f64))
            }
        }
        deserializer.deserialize_any(NumberVisitor)
    }
}

/// Three finite numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triple(pub(super) DVec3);

impl<'de> Deserialize<'de> for Triple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TripleVisitor { or_one: false }).map(Self)
    }
}

/// Reads three numbers, or one that stands for all three.
struct TripleVisitor {
    or_one: bool,
}

impl<'de> Visitor<'de> for TripleVisitor {
    type Value = DVec3;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let one = if self.or_one { "a number such as 2.0 or " } else { "" };
        write!(f, "{one}three numbers such as [0.0, 1.0, 0.0]")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<DVec3, E> {
        let accepted = (self.or_one && value.is_finite()).then_some(DVec3::splat(value));
        accepted.ok_or_else(|| E::invalid_type(de::Unexpected::Float(value), &self))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<DVec3, E> {
        let accepted = self.or_one.then_some(DVec3::splat(value as f64));
        accepted.ok_or_else(|| E::invalid_type(de::Unexpected::Signed(value), &self))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<DVec3, A::Error> {
        let mut values = Vec::with_capacity(3);
        while let Some(Number(value)) = sequence.next_element()? {
            values.push(value);
        }
        match values[..] {
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            _ => Err(de::Error::invalid_length(values.len(), &self)),
        }
    }
}

/// Defines a number or three numbers with a condition and words for it.
macro_rules! checked {
    ($(#[$doc:meta])* $name:ident, $raw:ident $raw_name:literal, $to:ty, $accepts:expr, $wanted:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, serde::Deserialize)]
        #[serde(try_from = $raw_name)]
        pub(super) struct $name(pub(super) $to);

        impl TryFrom<$raw> for $name {
            type Error = String;

            fn try_from($raw(value): $raw) -> Result<Self, String> {
                let accepts: fn($to) -> bool = $accepts;
                let accepted = accepts(value).then_some(Self(value));
                accepted.ok_or_else(|| format!("{value} is not {}", $wanted))
            }
        }
    };
}

checked!(
    /// A length above zero, metres.
    Length, Number "Number", f64,
    |v| v > 1e-12 && v <= LARGEST_M,
    "a length in metres from 1e-12 to 1e12; write such as 1.0"
);
checked!(
    /// Zero or more.
    NonNegative, Number "Number", f64,
    |v| (0.0..=LARGEST_M).contains(&v),
    "a number from 0 to 1e12; write such as 0.5"
);
checked!(
    /// From 0 to 1.
    Share, Number "Number", f64,
    |v| (0.0..=1.0).contains(&v),
    "a share from 0 to 1; write such as 0.5"
);
checked!(
    /// Full angle of a pinhole camera, degrees.
    FieldOfView, Number "Number", f64,
    |v| (1e-3..=175.0).contains(&v),
    "a full vertical angle from 0.001 to 175 degrees; write such as 35.0"
);
checked!(
    /// Angular radius of the sun's disc, degrees.
    DiscRadius, Number "Number", f64,
    |v| (0.01..=45.0).contains(&v),
    "an angular radius from 0.01 to 45 degrees; write such as 0.27 for the real sun"
);
checked!(
    /// An angle in degrees, any number of turns that f64 resolves.
    Angle, Number "Number", f64,
    |v| v.abs() <= 1e6,
    "an angle in degrees; write such as 30.0"
);
checked!(
    /// A time, seconds.
    Seconds, Number "Number", f64,
    |v| v > 0.0 && v <= 1e9,
    "a time in seconds above 0; write such as 0.04"
);
checked!(
    /// A position or offset, metres.
    Position, Triple "Triple", DVec3,
    |v| v.abs().max_element() <= LARGEST_M,
    "a position within 1e12 metres; write such as [0.0, 1.0, 4.0]"
);
checked!(
    /// Three lengths above zero, metres.
    Lengths, Triple "Triple", DVec3,
    |v| v.min_element() > 1e-12 && v.max_element() <= LARGEST_M,
    "three lengths above 0; write such as [1.0, 0.5, 1.0]"
);
checked!(
    /// Linear R, G, B, zero or more.
    Light, Triple "Triple", DVec3,
    |v| v.min_element() >= 0.0 && v.max_element() <= BRIGHTEST,
    "linear R, G, B from 0 to 1e30; write such as [1.0, 1.0, 1.0]"
);
checked!(
    /// Linear R, G, B from 0 to 1.
    Albedo, Triple "Triple", DVec3,
    |v| v.min_element() >= 0.0 && v.max_element() <= 1.0,
    "linear R, G, B from 0 to 1; write such as [0.8, 0.8, 0.8]"
);
checked!(
    /// Three angles, degrees.
    Angles, Triple "Triple", DVec3,
    |v| v.abs().max_element() <= 1e6,
    "three angles in degrees; write such as [0.0, 30.0, 0.0]"
);

/// A unit vector; the file may give any length but zero.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(try_from = "Triple")]
pub(super) struct Direction(pub(super) DVec3);

impl TryFrom<Triple> for Direction {
    type Error = String;

    fn try_from(Triple(value): Triple) -> Result<Self, String> {
        let scaled = value / value.abs().max_element();
        let unit = scaled.try_normalize().map(Self);
        unit.ok_or_else(|| format!("{value} points nowhere; write such as [0.0, 1.0, 0.0]"))
    }
}

/// One factor above zero for all axes, or one for each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale(pub(super) DVec3);

impl<'de> Deserialize<'de> for Scale {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = deserializer.deserialize_any(TripleVisitor { or_one: true })?;
        let accepted = value.min_element() >= 1e-12 && value.max_element() <= 1e12;
        accepted.then_some(Self(value)).ok_or_else(|| {
            de::Error::custom(format!(
                "{value} is not a scale from 1e-12 to 1e12; write such as 2.0 (a mirrored body would be inside out)"
            ))
        })
    }
}

/// Width and height of an image.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(try_from = "(i64, i64)")]
pub(super) struct Resolution(pub(super) [u32; 2]);

impl TryFrom<(i64, i64)> for Resolution {
    type Error = String;

    fn try_from((width, height): (i64, i64)) -> Result<Self, String> {
        let accepted = |side: i64| (1..=16_384).contains(&side);
        let both = accepted(width) && accepted(height);
        both.then_some(Self([width as u32, height as u32])).ok_or_else(|| {
            format!(
                "{width} x {height} is not a size that can be rendered; write 1 to 16384 pixels \
                 for width and height, such as [512, 512]"
            )
        })
    }
}

/// Defines a whole number with limits.
macro_rules! count {
    ($(#[$doc:meta])* $name:ident, $range:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, serde::Deserialize)]
        #[serde(try_from = "i64")]
        pub(super) struct $name(pub(super) u32);

        impl TryFrom<i64> for $name {
            type Error = String;

            fn try_from(value: i64) -> Result<Self, String> {
                let range: std::ops::RangeInclusive<i64> = $range;
                range.contains(&value).then_some(Self(value as u32)).ok_or_else(|| {
                    format!("{value} is not a whole number from {} to {}", range.start(), range.end())
                })
            }
        }
    };
}

count!(
    /// Frames of a sequence.
    Frames, 1..=1_000_000
);
count!(
    /// Cracks in a body.
    Cracks, 0..=64
);
count!(
    /// Grid points along a crack.
    CrackGrid, 8..=128
);
count!(
    /// Textured planes of the image-space air.
    AirPlanes, 0..=64
);
count!(
    /// Bubbles of the exact stand-in.
    Bubbles, 0..=4096
);
count!(
    /// Exposures of the perceptual metric.
    ExposureCount, 1..=64
);

/// Edge of a cube face: a power of two.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(try_from = "i64")]
pub(super) struct CubeSize(pub(super) u32);

impl TryFrom<i64> for CubeSize {
    type Error = String;

    fn try_from(value: i64) -> Result<Self, String> {
        let accepted = (16..=4096).contains(&value) && (value & (value - 1)) == 0;
        accepted.then_some(Self(value as u32)).ok_or_else(|| {
            format!("{value} is not a power of two from 16 to 4096; write such as 512")
        })
    }
}
