//! Values that are written in one of two ways.

use super::number::{Albedo, Length, Light};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// The name of something defined elsewhere, or the thing itself.
#[derive(Clone, Debug)]
pub(super) enum NameOr<T> {
    Name(String),
    Inline(T),
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for NameOr<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Either<T> {
            type Value = NameOr<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name in quotes or a table { … }")
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<NameOr<T>, E> {
                Ok(NameOr::Name(name.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<NameOr<T>, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map)).map(NameOr::Inline)
            }
        }
        deserializer.deserialize_any(Either(PhantomData))
    }
}

/// Colour of a surface: three numbers, or a checker of two colours.
#[derive(Clone, Copy, Debug)]
pub(super) enum PaintText<T> {
    Constant(T),
    Checker(CheckerText<T>),
}

/// Two colours in cubes.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CheckerText<T> {
    pub(super) checker: [T; 2],
    pub(super) size_m: Length,
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for PaintText<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Either<T> {
            type Value = PaintText<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "three numbers such as [0.8, 0.8, 0.8], or { checker = [[1.0, 1.0, 1.0], \
                     [0.1, 0.1, 0.1]], size_m = 0.5 }",
                )
            }

            fn visit_seq<A: SeqAccess<'de>>(self, values: A) -> Result<PaintText<T>, A::Error> {
                T::deserialize(SeqAccessDeserializer::new(values)).map(PaintText::Constant)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<PaintText<T>, A::Error> {
                let checker = CheckerText::deserialize(MapAccessDeserializer::new(map))?;
                Ok(PaintText::Checker(checker))
            }
        }
        deserializer.deserialize_any(Either(PhantomData))
    }
}

/// Colours that a paint can hold.
pub(super) trait Colour: Copy {
    /// Linear R, G, B.
    fn rgb(self) -> glam::DVec3;
}

impl Colour for Light {
    fn rgb(self) -> glam::DVec3 {
        self.0
    }
}

impl Colour for Albedo {
    fn rgb(self) -> glam::DVec3 {
        self.0
    }
}

impl<T: Colour> PaintText<T> {
    /// The paint as renderers see it.
    pub(super) fn paint(self) -> crate::scene::Paint {
        match self {
            Self::Constant(colour) => crate::scene::Paint::Constant(colour.rgb()),
            Self::Checker(CheckerText { checker, size_m }) => {
                crate::scene::Paint::Checker { colours: checker.map(T::rgb), size_m: size_m.0 }
            }
        }
    }
}
