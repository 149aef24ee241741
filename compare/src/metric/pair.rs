//! Two images side by side, and the value of each metric on them.

use super::exit_angle::{ExitAngles, exit_angle_map_deg, summarise, unmatched_share};
use super::judgement_error::JudgementError;
use super::{Candidate, Encoding, Exposures, Mask, Metric, Reference, Selection};
use super::{display, error, flip, pu21, relative, ssim, stack};
use crate::support::sum::mean;
use scenes::{Layer, LayerName, Layers};
use std::sync::OnceLock;

/// Two sides of one layer.
#[derive(Clone, Copy)]
pub(super) struct Sides<'a> {
    pub(super) reference: &'a [f64],
    pub(super) candidate: &'a [f64],
}

/// A pair of images with what several metrics share.
pub(super) struct Pair<'a> {
    pub(super) selection: &'a Selection,
    pub(super) size_px: [usize; 2],
    pub(super) radiance: Option<Sides<'a>>,
    pub(super) exit: Option<Sides<'a>>,
    /// Variance of the reference's radiance, three channels.
    pub(super) variance: Option<&'a [f64]>,
    coverage: Option<&'a [f64]>,
    flip: OnceLock<flip::FlipMap>,
    /// Maps of the three channels, made once for all sets of pixels.
    ssim: OnceLock<Option<SsimMaps>>,
}

/// SSIM of every window of each channel, row by row.
type SsimMaps = [Vec<f64>; 3];

/// A value, or why there is none.
pub(super) enum Answer {
    Value(f64, u64),
    /// A value whose uncertainty is known.
    Corrected(stack::CorrectedError, u64),
    /// Infinite for equal images.
    Endless,
    Undefined(String),
}

impl<'a> Pair<'a> {
    pub(super) fn new(
        Reference(reference): Reference<'a>,
        Candidate(candidate): Candidate<'a>,
        selection: &'a Selection,
    ) -> Result<Self, JudgementError> {
        if reference.resolution_px != candidate.resolution_px {
            let (reference, candidate) = (reference.resolution_px, candidate.resolution_px);
            return Err(JudgementError::Size { reference, candidate });
        }
        let sides = |name: LayerName| -> Result<Option<Sides<'a>>, JudgementError> {
            let (Some(r), Some(t)) = (three(reference, &name), three(candidate, &name)) else {
                return Ok(None);
            };
            if let Some(reason) = not_finite(r, reference) {
                return Err(JudgementError::Reference(reason));
            }
            Ok(Some(Sides { reference: &r.data, candidate: &t.data }))
        };
        let (radiance, exit) = (sides(LayerName::Radiance)?, sides(LayerName::Exit)?);
        if radiance.is_none() && exit.is_none() {
            return Err(JudgementError::NothingShared);
        }
        Ok(Self {
            selection,
            size_px: reference.resolution_px.map(|side| side as usize),
            radiance,
            exit,
            variance: three(reference, &LayerName::Variance).map(|layer| layer.data.as_slice()),
            coverage: reference.get(&LayerName::Coverage).map(|layer| layer.data.as_slice()),
            flip: OnceLock::new(),
            ssim: OnceLock::new(),
        })
    }

    pub(super) fn pixel_count(&self) -> usize {
        self.size_px[0] * self.size_px[1]
    }

    /// Indices of the pixels in a mask; `None` for all.
    pub(super) fn pixels(&self, mask: Mask) -> Result<Option<Vec<usize>>, String> {
        match (mask, self.coverage) {
            (Mask::All, _) => Ok(None),
            (Mask::Object, None) => Err("the reference has no coverage layer".to_owned()),
            (Mask::Object, Some(coverage)) => {
                let covered = coverage.iter().enumerate().filter(|(_, share)| **share > 0.0);
                Ok(Some(covered.map(|(pixel, _)| pixel).collect()))
            }
        }
    }

    /// The value of a metric, over the chosen pixels.
    pub(super) fn answer(&self, metric: Metric, sides: Sides, pixels: Option<&[usize]>) -> Answer {
        let gathered = [gather(sides.reference, pixels), gather(sides.candidate, pixels)];
        let (r, t) = (&*gathered[0], &*gathered[1]);
        let n = (r.len() / 3) as u64;
        let number = |value: f64| Answer::Value(value, n);
        let decibels = |value: Option<f64>| value.map_or(Answer::Endless, number);
        match metric {
            Metric::Bias => number(error::bias(r, t)),
            Metric::Mae => number(error::mae(r, t)),
            Metric::Mse => number(error::mse(r, t)),
            Metric::Rmse => number(error::rmse(r, t)),
            Metric::MaxAbs => number(error::max_abs(r, t)),
            Metric::RelMse => match &self.selection.frozen {
                Some(frozen) => {
                    number(relative::relmse_frozen(r, t, &gather(frozen, pixels), 1e-2))
                }
                None => number(relative::relmse(r, t, 1e-2)),
            },
            Metric::RelMseTrimmed => number(relative::relmse_trimmed(r, t, 1e-2, 1e-3)),
            Metric::WorstThousandth => {
                number(relative::worst_share(r, t, 1e-2, r.len() / 3 / 1000))
            }
            Metric::WorstHundred => number(relative::worst_share(r, t, 1e-2, 100)),
            Metric::MseCorrected => match self.variance {
                Some(variance) => {
                    let variance = gather(variance, pixels);
                    Answer::Corrected(stack::corrected_mse_by_variance(r, t, &variance), n)
                }
                None => Answer::Undefined("the reference has no variance layer".to_owned()),
            },
            Metric::Mape => number(relative::mape(r, t, 1e-2)),
            Metric::Smape => number(relative::smape(r, t, 1e-2)),
            Metric::HdrFlip | Metric::LdrFlip => self.flip(sides, pixels),
            Metric::Pu21Psnr => decibels(pu21::pu21_psnr_db(r, t, self.selection.nits_per_unit)),
            Metric::Psnr => decibels(display::psnr_db(r, t, 1.0)),
            Metric::PsnrToneMapped => decibels(display::psnr_db(&codes(r), &codes(t), 255.0)),
            Metric::Ssim | Metric::SsimToneMapped => self.ssim(sides, pixels),
            Metric::ExitUnmatched => match unmatched_share(r, t) {
                Some(share) => number(share),
                None => Answer::Undefined("no pixel has an exit".to_owned()),
            },
            Metric::ExitAngleMedian => of_angles(r, t, |angles| angles.median_deg),
            Metric::ExitAngleP95 => of_angles(r, t, |angles| angles.p95_deg),
            Metric::ExitAngleMean => of_angles(r, t, |angles| angles.mean_deg),
            Metric::ExitWithin1Deg => of_angles(r, t, |angles| angles.share_within_1_deg),
        }
    }

    /// The FLIP map, if some metric needed it.
    pub(super) fn flip_map(self) -> Option<Vec<f64>> {
        self.flip.into_inner()?.ok()
    }

    /// Mean of the FLIP map, which is made once for all masks.
    fn flip(&self, sides: Sides, pixels: Option<&[usize]>) -> Answer {
        let map = self.flip.get_or_init(|| {
            let (r, t) = (sides.reference, sides.candidate);
            if self.selection.encoding == Encoding::Display {
                return flip::ldr_flip_map(r, t, self.size_px, flip::PIXELS_PER_DEGREE);
            }
            let exposures = self.selection.flip_exposures.or_else(|| Exposures::of(r));
            let exposures = exposures
                .ok_or("the reference is black and the scene pins no exposures".to_owned())?;
            flip::hdr_flip_map(r, t, self.size_px, exposures)
        });
        match (map, pixels) {
            (Err(reason), _) => Answer::Undefined(reason.clone()),
            (Ok(map), None) => Answer::Value(mean(map.iter().copied()), map.len() as u64),
            (Ok(map), Some(pixels)) => {
                Answer::Value(mean(pixels.iter().map(|&p| map[p])), pixels.len() as u64)
            }
        }
    }

    /// The maps of SSIM: of code values, which linear radiance gets by tone mapping. A pair
    /// has one encoding, so that it has one of both.
    fn ssim_maps(&self, sides: Sides) -> Option<SsimMaps> {
        let (r, t, range) = match self.selection.encoding {
            Encoding::Display => (sides.reference.into(), sides.candidate.into(), 1.0),
            Encoding::Linear => {
                let [r, t] = [sides.reference, sides.candidate].map(|side| codes(side).into());
                (r, t, 255.0)
            }
        };
        let one = |image: &std::borrow::Cow<[f64]>, channel: usize| -> Vec<f64> {
            image.iter().skip(channel).step_by(3).copied().collect()
        };
        let map =
            |channel| ssim::ssim_map(&one(&r, channel), &one(&t, channel), self.size_px, range);
        Some([map(0)?, map(1)?, map(2)?])
    }

    /// Mean SSIM of the three channels over the pixels that have a window.
    fn ssim(&self, sides: Sides, pixels: Option<&[usize]>) -> Answer {
        let Some(maps) = self.ssim.get_or_init(|| self.ssim_maps(sides)) else {
            return Answer::Undefined("SSIM needs 11x11 pixels".to_owned());
        };
        let [width, _] = self.size_px;
        let inner = width.saturating_sub(ssim::SMALLEST_SIDE_PX - 1);
        let border = ssim::SMALLEST_SIDE_PX / 2;
        let mut values = Vec::new();
        for map in maps {
            match pixels {
                None => values.extend(map),
                Some(pixels) => values.extend(pixels.iter().filter_map(|&pixel| {
                    let (x, y) = (pixel % width, pixel / width);
                    let (x, y) = (x.checked_sub(border)?, y.checked_sub(border)?);
                    (x < inner).then(|| map.get(y * inner + x).copied())?
                })),
            }
        }
        if values.is_empty() {
            return Answer::Undefined("no judged pixel is 5 pixels from the border".to_owned());
        }
        Answer::Value(mean(values.iter().copied()), values.len() as u64 / 3)
    }
}

/// One figure of the angles between exits.
fn of_angles(r: &[f64], t: &[f64], figure: impl Fn(&ExitAngles) -> f64) -> Answer {
    match summarise(exit_angle_map_deg(r, t)) {
        Some(angles) => Answer::Value(figure(&angles), angles.n as u64),
        None => Answer::Undefined("no pixel has an exit on both sides".to_owned()),
    }
}

fn codes(radiance: &[f64]) -> Vec<f64> {
    radiance.iter().map(|&value| display::code_value(value)).collect()
}

/// The three channels of the chosen pixels.
fn gather<'a>(values: &'a [f64], pixels: Option<&[usize]>) -> std::borrow::Cow<'a, [f64]> {
    match pixels {
        None => values.into(),
        Some(pixels) => {
            pixels.iter().flat_map(|&pixel| [0, 1, 2].map(|i| values[3 * pixel + i])).collect()
        }
    }
}

fn three<'a>(layers: &'a Layers, name: &LayerName) -> Option<&'a Layer> {
    layers.get(name).filter(|layer| layer.channels == 3)
}

fn not_finite(layer: &Layer, layers: &Layers) -> Option<String> {
    let reason = values_not_finite(&layer.data, layers.resolution_px[0] as usize)?;
    Some(format!("layer {}: {reason}", layer.name))
}

/// How many values are NaN or infinite and where the first is.
pub(super) fn values_not_finite(values: &[f64], width: usize) -> Option<String> {
    let count = values.iter().filter(|value| !value.is_finite()).count();
    let first = values.iter().position(|value| !value.is_finite())? / 3;
    Some(format!(
        "{count} of {} values are NaN or infinite, the first at pixel ({}, {})",
        values.len(),
        first % width,
        first / width
    ))
}
