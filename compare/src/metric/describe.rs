//! What each metric is: name, formula, unit, range, direction, source.

use super::{Encoding, Selection};

/// A metric that a pair of images may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is described by `Metric::describe`")]
pub enum Metric {
    ExitAngleMedian,
    ExitAngleP95,
    ExitAngleMean,
    ExitWithin1Deg,
    ExitUnmatched,
    RelMse,
    RelMseTrimmed,
    WorstThousandth,
    WorstHundred,
    HdrFlip,
    LdrFlip,
    Bias,
    Mae,
    Mse,
    Rmse,
    MseCorrected,
    MaxAbs,
    Mape,
    Smape,
    Pu21Psnr,
    PsnrToneMapped,
    SsimToneMapped,
    Psnr,
    Ssim,
}

/// Which way a metric improves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// Smaller is better.
    Lower,
    /// Larger is better.
    Higher,
    /// The closer to zero the better.
    NearZero,
    /// Neither: it tells how to read another metric.
    Neither,
}

/// The layer that a metric compares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compared {
    /// Colours.
    Radiance,
    /// Directions in which primary chains leave.
    Exit,
}

/// Everything about a metric but its computation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description {
    /// Name in results; the radiance scale of PU21 is appended to its name.
    pub name: &'static str,
    /// Definition; d = t - r, candidate t, reference r, all in f64.
    pub formula: &'static str,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// Possible values.
    pub range: &'static str,
    /// Which way it improves.
    pub better: Better,
    /// Where it is defined.
    pub source: &'static str,
    /// What it compares.
    pub of: Compared,
    /// The encoding that it is defined for; `None`: any.
    pub encoding: Option<Encoding>,
    /// Its value for equal images, which need not be computed; `None`: infinite.
    pub if_equal: Option<f64>,
    /// Why it has no interval; empty if it can have one.
    pub no_interval: &'static str,
}

use Better::{Higher, Lower, NearZero, Neither};
use Encoding::{Display, Linear};

/// An error of radiance in any encoding, 0 for equal images.
const fn new(
    name: &'static str,
    unit: &'static str,
    range: &'static str,
    better: Better,
    formula: &'static str,
    source: &'static str,
) -> Description {
    let (of, encoding, if_equal) = (Compared::Radiance, None, Some(0.0));
    let no_interval = "";
    Description { name, formula, unit, range, better, source, of, encoding, if_equal, no_interval }
}

impl Description {
    const fn of_exits(self) -> Self {
        Self { of: Compared::Exit, ..self }
    }

    const fn only(self, encoding: Encoding) -> Self {
        Self { encoding: Some(encoding), ..self }
    }

    const fn without_interval(self, why: &'static str) -> Self {
        Self { no_interval: why, ..self }
    }

    const fn if_equal(self, value: Option<f64>) -> Self {
        Self { if_equal: value, ..self }
    }
}

const ANGLE: &str = "∠ = atan2(|a × b|, a · b) where both chains leave";
const FLIP: &str = "Andersson et al. 2020 (LDR), 2021 (HDR); FLIP 1.7";
const WANG: &str = "Wang et al. 2004, IEEE TIP 13(4)";
const PLAIN: &str = "elementary";
const OF_THESE: &str = "it tells of these very pixels";
const TONE_MAPPED_PSNR: &str =
    "10 log10(255² / mean d²) of 8-bit code values: x/(1+x), sRGB curve, rounded half up";
const TONE_MAPPED_SSIM: &str =
    "mean SSIM of the channels' 8-bit code values: x/(1+x), sRGB curve, rounded half up";

impl Metric {
    /// Every metric, figures of merit first.
    pub const ALL: [Self; 24] = [
        Self::ExitAngleMedian,
        Self::ExitAngleP95,
        Self::ExitAngleMean,
        Self::ExitWithin1Deg,
        Self::ExitUnmatched,
        Self::RelMse,
        Self::RelMseTrimmed,
        Self::WorstThousandth,
        Self::WorstHundred,
        Self::HdrFlip,
        Self::LdrFlip,
        Self::Bias,
        Self::Mae,
        Self::Mse,
        Self::Rmse,
        Self::MseCorrected,
        Self::MaxAbs,
        Self::Mape,
        Self::Smape,
        Self::Pu21Psnr,
        Self::PsnrToneMapped,
        Self::SsimToneMapped,
        Self::Psnr,
        Self::Ssim,
    ];

    /// Name, formula, unit, range, direction and source.
    #[must_use]
    pub const fn describe(self) -> Description {
        let up = "0 upwards";
        match self {
            Self::ExitAngleMedian => {
                new("exit_angle_median_deg", "deg", "0 to 180", Lower, ANGLE, PLAIN).of_exits()
            }
            Self::ExitAngleP95 => {
                new("exit_angle_p95_deg", "deg", "0 to 180", Lower, ANGLE, PLAIN).of_exits()
            }
            Self::ExitAngleMean => {
                new("exit_angle_mean_deg", "deg", "0 to 180", Lower, ANGLE, PLAIN).of_exits()
            }
            Self::ExitWithin1Deg => {
                let formula = "share of ∠ <= 1°";
                new("exit_angle_within_1deg", "", "0 to 1", Higher, formula, PLAIN)
                    .of_exits()
                    .if_equal(Some(1.0))
            }
            Self::ExitUnmatched => {
                let formula = "pixels with an exit on one side only / on any side";
                new("exit_unmatched", "", "0 to 1", Lower, formula, PLAIN).of_exits()
            }
            Self::RelMse => {
                let source = "Rousselle, Knaus & Zwicker 2011, ACM TOG 30(6)";
                new("relmse_e1e-2", "", up, Lower, "mean d² / (r² + 0.01)", source)
            }
            Self::RelMseTrimmed => {
                let formula = "relmse_e1e-2 without the ⌊N/1000⌋ worst pixels";
                new("relmse_e1e-2_trim0.1", "", up, Lower, formula, PLAIN)
            }
            Self::WorstThousandth => {
                let formula = "share of relmse_e1e-2 that the ⌊N/1000⌋ worst pixels carry";
                new("relmse_e1e-2_share_worst0.1", "", "0 to 1", Neither, formula, PLAIN)
                    .without_interval(OF_THESE)
            }
            Self::WorstHundred => {
                let formula = "share of relmse_e1e-2 that the 100 worst pixels carry";
                new("relmse_e1e-2_share_worst100", "", "0 to 1", Neither, formula, PLAIN)
                    .without_interval(OF_THESE)
            }
            Self::HdrFlip => {
                let formula = "mean HDR-FLIP, ACES, 67.02 pixels per degree, pinned exposures";
                new("flip_hdr", "", "0 to 1", Lower, formula, FLIP).only(Linear)
            }
            Self::LdrFlip => {
                let formula = "mean LDR-FLIP, 67.02 pixels per degree";
                new("flip_ldr", "", "0 to 1", Lower, formula, FLIP).only(Display)
            }
            Self::Bias => new("bias", "radiance", "any", NearZero, "mean d", PLAIN),
            Self::Mae => new("mae", "radiance", up, Lower, "mean |d|", PLAIN),
            Self::Mse => new("mse", "radiance²", up, Lower, "mean d²", PLAIN),
            Self::Rmse => new("rmse", "radiance", up, Lower, "√(mean d²)", PLAIN),
            Self::MseCorrected => {
                let formula = "mean (d² - variance of r): the reference's noise subtracted";
                new("mse_corrected", "radiance²", "any", Lower, formula, PLAIN).only(Linear)
            }
            Self::MaxAbs => new("max_abs", "radiance", up, Lower, "max |d|", PLAIN)
                .without_interval("a largest value is no mean"),
            Self::Mape => new("mape_e1e-2", "", up, Lower, "mean |d| / (|r| + 0.01)", PLAIN),
            Self::Smape => {
                let formula = "mean 2|d| / (|r| + |t| + 0.02)";
                new("smape_e1e-2", "", "0 to 2", Lower, formula, PLAIN)
            }
            Self::Pu21Psnr => {
                let formula = "10 log10(256² / mean d²) of PU21-encoded channels";
                new("pu21_psnr", "dB", "any", Higher, formula, "Mantiuk & Azimi 2021, PCS")
                    .only(Linear)
                    .if_equal(None)
            }
            Self::PsnrToneMapped => {
                new("psnr_reinhard_srgb8", "dB", "any", Higher, TONE_MAPPED_PSNR, PLAIN)
                    .only(Linear)
                    .if_equal(None)
            }
            Self::SsimToneMapped => {
                new("ssim_reinhard_srgb8", "", "-1 to 1", Higher, TONE_MAPPED_SSIM, WANG)
                    .only(Linear)
                    .if_equal(Some(1.0))
            }
            Self::Psnr => {
                new("psnr", "dB", "any", Higher, "10 log10(1 / mean d²) of code values", PLAIN)
                    .only(Display)
                    .if_equal(None)
            }
            Self::Ssim => {
                let formula = "mean SSIM of the channels' code values";
                new("ssim", "", "-1 to 1", Higher, formula, WANG).only(Display).if_equal(Some(1.0))
            }
        }
    }

    /// Name in results, with every constant that the selection chooses.
    #[must_use]
    pub fn name(self, selection: &Selection) -> String {
        let name = self.describe().name;
        if self == Self::Pu21Psnr {
            return format!("{name}_x{}", selection.nits_per_unit);
        }
        let frozen = self == Self::RelMse && selection.frozen.is_some();
        format!("{name}{}", if frozen { "_frozen" } else { "" })
    }

    /// True for means of the FLIP map.
    pub(super) const fn is_flip(self) -> bool {
        matches!(self, Self::HdrFlip | Self::LdrFlip)
    }

    /// True if images of that encoding can have this metric.
    #[must_use]
    pub fn takes(self, encoding: Encoding) -> bool {
        self.describe().encoding.is_none_or(|only| only == encoding)
    }

    /// The metric of that name in results, if it is one of ours.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|metric| {
            let own = metric.describe().name;
            name == own || (*metric == Self::Pu21Psnr && name.starts_with(own))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The enumeration has no more members than the list, and each is there once.
    #[test]
    fn the_list_holds_every_metric_once() {
        for (place, metric) in Metric::ALL.into_iter().enumerate() {
            assert_eq!(metric as usize, place, "{metric:?}");
            assert_eq!(Metric::named(metric.describe().name), Some(metric));
        }
        let source = include_str!("describe.rs");
        let body = source.split("pub enum Metric {").nth(1).and_then(|rest| rest.split('}').next());
        assert_eq!(body.map_or(0, |body| body.matches(',').count()), Metric::ALL.len());
    }
}
