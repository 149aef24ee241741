//! Limits of metrics: `flip_hdr=0.05`.

use super::verdict::{Check, Outcome};
use crate::metric::{Better, Mask, Measurement, Metric};
use crate::results::Validity;
use std::collections::BTreeMap;

/// How far an image may be from its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Of what.
    pub metric: Metric,
    /// Most, or least where more is better; most |value| where zero is best.
    pub value: f64,
}

impl Limit {
    /// A limit by the name of its metric in results.
    ///
    /// # Errors
    /// If there is no such metric, with the names that there are, or the value is
    /// not a finite number.
    pub fn new(name: &str, value: f64) -> Result<Self, String> {
        let metric = Metric::named(name)
            .ok_or_else(|| format!("there is no metric \"{name}\"; there are: {}", names(None)))?;
        match value.is_finite() {
            true => Ok(Self { metric, value }),
            false => Err(format!("the limit {value} of {name} is not a finite number")),
        }
    }

    /// Reads `NAME=VALUE`.
    ///
    /// # Errors
    /// As [`Limit::new`], and for text of another form.
    pub fn read(text: &str) -> Result<Self, String> {
        let form = || format!("`{text}`: write NAME=VALUE, such as flip_hdr=0.05");
        let (name, value) = text.split_once('=').ok_or_else(form)?;
        let value = value.trim().parse().map_err(|_| form())?;
        Self::new(name.trim(), value)
    }

    /// Limits from a table of a file.
    ///
    /// # Errors
    /// As [`Limit::new`].
    pub fn all(table: &BTreeMap<String, f64>) -> Result<Vec<Self>, String> {
        table.iter().map(|(name, value)| Self::new(name, *value)).collect()
    }

    /// True if the value is on the right side.
    fn holds(&self, value: f64) -> bool {
        match self.metric.describe().better {
            Better::Lower => value <= self.value,
            Better::Higher => value >= self.value,
            // A user who sets a limit on a share means its upper end.
            Better::Neither => value <= self.value,
            Better::NearZero => value.abs() <= self.value,
        }
    }
}

/// Holds measurements of one pair to limits.
///
/// # Errors
/// If a limit is of a metric that such a pair cannot have, with those it has.
pub fn check(
    cell: &str,
    measurements: &[Measurement],
    mask: Mask,
    limits: &[Limit],
) -> Result<Vec<Check>, String> {
    let one = |limit: &Limit| {
        let found = measurements
            .iter()
            .find(|m| m.mask == mask && Metric::named(&m.metric) == Some(limit.metric));
        let Some(found) = found else {
            return Err(format!(
                "{cell}: {} cannot be held to a limit, as this pair does not have it; it has: {}",
                limit.metric.describe().name,
                names(Some(measurements))
            ));
        };
        Ok(held(cell, found, limit))
    };
    limits.iter().map(one).collect()
}

fn held(cell: &str, found: &Measurement, limit: &Limit) -> Check {
    let (outcome, reason) = match (found.value, found.status) {
        (Some(value), _) if limit.holds(value) => (Outcome::Pass, String::new()),
        (Some(_), _) => (Outcome::Fail, "beyond its limit".to_owned()),
        // Equal images: infinitely many decibels.
        (None, Validity::Identical) => (Outcome::Pass, found.reason.clone()),
        (None, _) => (Outcome::Fail, found.reason.clone()),
    };
    let metric = format!("limit_{}", found.metric);
    Check {
        head: found.value,
        margin: Some(limit.value),
        ..Check::plain(cell, &metric, outcome, reason)
    }
}

/// Names of all metrics, or of those that were measured.
fn names(measured: Option<&[Measurement]>) -> String {
    let known: Vec<String> = match measured {
        Some(list) => {
            let mut names: Vec<String> = list.iter().map(|m| m.metric.clone()).collect();
            names.dedup();
            names
        }
        None => Metric::ALL.iter().map(|metric| metric.describe().name.to_owned()).collect(),
    };
    known.join(", ")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;

    #[test]
    fn a_limit_is_of_the_side_on_which_a_metric_is_worse() {
        let holds = |text: &str, value| Limit::read(text).unwrap().holds(value);
        assert!(holds("flip_hdr=0.05", 0.05) && !holds("flip_hdr=0.05", 0.051));
        assert!(holds("psnr=30", 31.0) && !holds("psnr=30", 29.0));
        assert!(holds("bias=0.1", -0.1) && !holds("bias=0.1", -0.2));
    }

    #[test]
    fn a_name_that_is_no_metric_gets_all_that_are() {
        let error = Limit::read("flip=0.05").unwrap_err();
        assert!(error.contains("\"flip\"") && error.contains("relmse_e1e-2_trim0.1"), "{error}");
        for wrong in ["flip_hdr", "flip_hdr=", "flip_hdr=x", "flip_hdr=nan", "=1"] {
            assert!(Limit::read(wrong).is_err(), "{wrong}");
        }
    }
}
