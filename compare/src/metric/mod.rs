//! How far a candidate image is from its reference.
//!
//! Metrics are pure functions over slices of f64; [`judge`] decides which of
//! them a pair of images has, and never makes a number of NaN or infinity.

pub mod describe;
pub mod display;
pub mod error;
pub mod exit_angle;
pub mod flip;
mod judge;
mod judgement_error;
mod pair;
pub mod pu21;
pub mod relative;
mod spread;
pub mod ssim;
pub mod stack;

pub use describe::{Better, Compared, Description, Metric};
pub use flip::Exposures;
pub use judge::{Judgement, judge};
pub use judgement_error::JudgementError;

pub use crate::results::Mask;
use crate::results::{ResultRow, RowKind, Validity};
use scenes::Layers;
pub use scenes::image::Encoding;
use schemars::JsonSchema;
use serde::Serialize;

/// The image that is taken as true.
#[derive(Clone, Copy, Debug)]
pub struct Reference<'a>(pub &'a Layers);

/// The image that is judged. A type of its own, so that the two sides of a
/// comparison cannot be swapped: most metrics divide by the reference.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a>(pub &'a Layers);

/// What is asked of [`judge`].
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Meaning of both radiance layers.
    pub encoding: Encoding,
    /// Metrics, in the order of the answer.
    pub metrics: Vec<Metric>,
    /// Sets of pixels; each metric is measured on each of them.
    pub masks: Vec<Mask>,
    /// Exposures of HDR-FLIP; from the reference itself if `None`.
    pub flip_exposures: Option<Exposures>,
    /// Luminance that radiance 1 stands for in PU21, cd/m².
    pub nits_per_unit: f64,
    /// Independent image for the denominators of the relative MSE.
    pub frozen: Option<Vec<f64>>,
}

impl Selection {
    /// Every metric that images of this encoding can have, on all pixels.
    #[must_use]
    pub fn all(encoding: Encoding) -> Self {
        Self {
            encoding,
            metrics: Metric::ALL.iter().copied().filter(|m| m.takes(encoding)).collect(),
            masks: vec![Mask::All],
            flip_exposures: None,
            nits_per_unit: 100.0,
            frozen: None,
        }
    }
}

/// One metric of one pair of images.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Measurement {
    /// Name, with its constants in it.
    pub metric: String,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// The pixels it is measured on.
    pub mask: Mask,
    /// The number, if there is one.
    pub value: Option<f64>,
    /// 95 % interval of the value, if it has one.
    #[serde(skip)]
    pub interval: Option<(f64, f64)>,
    /// What the interval is of, or why there is none.
    pub ci_of: String,
    /// Pixels behind the value.
    pub n: u64,
    /// Whether the value can be used.
    pub status: Validity,
    /// Why there is no number; empty when there is one.
    pub reason: String,
    /// How it is defined; d = candidate - reference.
    pub formula: String,
}

impl Measurement {
    /// The measurement as a row; everything that is not the measurement's own
    /// (scene, method, adapter, ...) comes from `common`.
    #[must_use]
    pub fn row(&self, common: &ResultRow) -> ResultRow {
        ResultRow {
            schema: crate::results::RESULT_SCHEMA.to_owned(),
            kind: RowKind::Error,
            metric: self.metric.clone(),
            unit: self.unit.to_owned(),
            mask: self.mask,
            value: self.value,
            ci_lo: self.interval.map(|(lo, _)| lo),
            ci_hi: self.interval.map(|(_, hi)| hi),
            ci_of: self.ci_of.clone(),
            n: self.n,
            status: self.status,
            reason: self.reason.clone(),
            ..common.clone()
        }
    }
}
