//! What head may be worse than base, per metric and class of adapter.

use crate::gate::AdapterClass;
use serde::{Deserialize, Deserializer, de};
use std::collections::BTreeMap;
use std::fmt;

/// What is gated. Everything else that is measured is reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub enum Gated {
    /// Mean of w d² with frozen weights w = 1 / (r0² + 0.01). A share is of
    /// base's own error, the noise of the truth subtracted.
    #[serde(rename = "relmse_e1e-2_frozen")]
    RelMse,
    /// |mean d|. A share is of the truth's mean.
    #[serde(rename = "bias")]
    Bias,
    /// Mean HDR-FLIP (LDR-FLIP of PNG files). A share is of base's own.
    #[serde(rename = "flip")]
    Flip,
    /// Each deterministic count of work. A share is of base's own.
    #[serde(rename = "work")]
    Work,
}

impl Gated {
    /// Name in files and results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::RelMse => "relmse_e1e-2_frozen",
            Self::Bias => "bias",
            Self::Flip => "flip",
            Self::Work => "work",
        }
    }
}

/// A margin: a number in the unit of the metric, or a share, written `"2 %"`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Margin {
    /// In the unit of the metric.
    Absolute(f64),
    /// Of what [`Gated`] says, 0.02 for 2 %.
    Share(f64),
}

impl Margin {
    /// In the unit of the metric.
    #[must_use]
    pub fn of(self, scale: f64) -> f64 {
        match self {
            Self::Absolute(value) => value,
            Self::Share(share) => share * scale.max(0.0),
        }
    }

    fn read(text: &str) -> Option<Self> {
        let percent = text.trim().strip_suffix('%')?.trim().parse::<f64>().ok()?;
        (percent.is_finite() && percent >= 0.0).then_some(Self::Share(percent / 100.0))
    }
}

impl<'de> Deserialize<'de> for Margin {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;
        impl de::Visitor<'_> for Reader {
            type Value = Margin;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number from 0, or a share such as \"2 %\"")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Margin, E> {
                match value.is_finite() && value >= 0.0 {
                    true => Ok(Margin::Absolute(value)),
                    false => Err(E::invalid_value(de::Unexpected::Float(value), &self)),
                }
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Margin, E> {
                self.visit_f64(value as f64)
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Margin, E> {
                Margin::read(text).ok_or_else(|| E::invalid_value(de::Unexpected::Str(text), &self))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

/// For which adapters a table of margins holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scope {
    /// Every class that has no table of its own.
    All,
    /// One class.
    Lavapipe,
    /// One class.
    Swiftshader,
    /// One class.
    OtherSoftware,
    /// One class.
    Hardware,
}

impl From<AdapterClass> for Scope {
    fn from(class: AdapterClass) -> Self {
        match class {
            AdapterClass::Lavapipe => Self::Lavapipe,
            AdapterClass::Swiftshader => Self::Swiftshader,
            AdapterClass::OtherSoftware => Self::OtherSoftware,
            AdapterClass::Hardware => Self::Hardware,
        }
    }
}

/// The margins that a file writes: `[margin.all]`, `[margin.hardware]`.
pub type Written = BTreeMap<Scope, BTreeMap<Gated, Margin>>;

/// The margins that hold on one class of adapters.
#[derive(Clone, Debug, PartialEq)]
pub struct Margins(BTreeMap<Gated, Margin>);

impl Margins {
    /// Ours where nothing is written, then those of `all`, then those of the class.
    #[must_use]
    pub fn of(written: &Written, class: Option<AdapterClass>) -> Self {
        let mut margins = BTreeMap::from([
            (Gated::RelMse, Margin::Share(0.02)),
            (Gated::Bias, Margin::Share(0.005)),
            (Gated::Flip, Margin::Absolute(0.002)),
            (Gated::Work, Margin::Share(0.01)),
        ]);
        for scope in [Some(Scope::All), class.map(Scope::from)].into_iter().flatten() {
            margins.extend(written.get(&scope).into_iter().flatten());
        }
        Self(margins)
    }

    /// The margin of a metric in its own unit.
    #[must_use]
    pub fn allow(&self, gated: Gated, scale: f64) -> f64 {
        self.0.get(&gated).map_or(0.0, |margin| margin.of(scale))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;

    #[derive(Deserialize)]
    struct Table {
        margin: Written,
    }

    fn read(text: &str) -> Result<Written, String> {
        toml::from_str::<Table>(text).map(|t| t.margin).map_err(|error| error.to_string())
    }

    #[test]
    fn the_class_goes_before_all_and_all_before_ours() {
        let text = "[margin.all]\nflip = 0.01\nbias = \"1 %\"\n[margin.hardware]\nflip = 0.05";
        let written = read(text).unwrap();
        let on = |class| Margins::of(&written, Some(class));
        assert_eq!(on(AdapterClass::Lavapipe).allow(Gated::Flip, 9.0), 0.01);
        assert_eq!(on(AdapterClass::Hardware).allow(Gated::Flip, 9.0), 0.05);
        assert_eq!(on(AdapterClass::Hardware).allow(Gated::Bias, 3.0), 0.03);
        assert_eq!(on(AdapterClass::Hardware).allow(Gated::RelMse, 3.0), 0.06);
        assert_eq!(on(AdapterClass::Hardware).allow(Gated::RelMse, -3.0), 0.0);
    }

    #[test]
    fn a_wrong_name_or_number_is_told() {
        let unknown = read("[margin.all]\nflop = 1").unwrap_err();
        assert!(unknown.contains("flop") && unknown.contains("relmse_e1e-2_frozen"), "{unknown}");
        let class = read("[margin.vulkan]\nflip = 1").unwrap_err();
        assert!(class.contains("lavapipe"), "{class}");
        for wrong in ["-1", "nan", "\"2\"", "\"-2 %\"", "\"x %\"", "true"] {
            let error = read(&format!("[margin.all]\nflip = {wrong}")).unwrap_err();
            assert!(error.contains("\"2 %\"") && error.contains("line 2"), "{wrong}: {error}");
        }
    }
}
