//! Which metrics a pair of images has, and what becomes of the others.

use super::judgement_error::JudgementError;
use super::pair::{Answer, Pair, Sides, values_not_finite};
use super::spread;
use super::{Candidate, Compared, Mask, Measurement, Metric, Reference, Selection};
use crate::results::{NotDone, Validity};
use rayon::prelude::*;

/// Everything that was asked about a pair, answered or left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judgement {
    /// In the order of the selection: per mask, per metric.
    pub measurements: Vec<Measurement>,
    /// Metrics that the pair does not have or does not need, with the reason.
    pub left_out: Vec<NotDone>,
    /// FLIP of each pixel, if FLIP was measured: it is the one metric that is
    /// slow enough to keep for the report.
    pub flip_map: Option<Vec<f64>>,
}

/// Measures a candidate against a reference.
///
/// A candidate with NaN or infinity gets status `invalid` and no number. Equal
/// images get status `identical` and are not computed.
///
/// # Errors
/// When the sizes differ, no layer is shared, or the reference itself holds
/// NaN or infinity.
pub fn judge(
    reference: Reference,
    candidate: Candidate,
    selection: &Selection,
) -> Result<Judgement, JudgementError> {
    let pair = Pair::new(reference, candidate, selection)?;
    let mut judgement = Judgement::default();
    for &mask in &selection.masks {
        match pair.pixels(mask) {
            Ok(pixels) => {
                for found in measure_all(&pair, mask, pixels.as_deref()) {
                    match found {
                        Ok(measurement) => judgement.measurements.push(measurement),
                        Err(reason) => judgement.left_out.push(reason),
                    }
                }
            }
            Err(reason) => {
                judgement.left_out.push(NotDone { what: format!("mask {mask:?}"), reason });
            }
        }
    }
    judgement.left_out.dedup();
    judgement.flip_map = pair.flip_map();
    Ok(judgement)
}

/// Every metric of the selection, in its order. They are measured side by side,
/// but the FLIPs one after another: they share a map, and whoever makes it must
/// not wait for itself.
fn measure_all(
    pair: &Pair,
    mask: Mask,
    pixels: Option<&[usize]>,
) -> Vec<Result<Measurement, NotDone>> {
    let one = |(place, metric): &(usize, Metric)| (*place, measure(pair, *metric, mask, pixels));
    let all = pair.selection.metrics.iter().copied().enumerate();
    let (flips, others): (Vec<_>, Vec<_>) = all.partition(|(_, metric)| metric.is_flip());
    let (mut found, of_flips) = rayon::join(
        || others.par_iter().map(one).collect::<Vec<_>>(),
        || flips.iter().map(one).collect::<Vec<_>>(),
    );
    found.extend(of_flips);
    found.sort_by_key(|(place, _)| *place);
    found.into_iter().map(|(_, found)| found).collect()
}

/// The metric as a number, or why it is left out.
fn measure(
    pair: &Pair,
    metric: Metric,
    mask: Mask,
    pixels: Option<&[usize]>,
) -> Result<Measurement, NotDone> {
    let sides = sides(pair, metric).map_err(|reason| NotDone {
        what: metric.name(pair.selection),
        reason: reason.to_owned(),
    })?;
    let mut found = Measurement {
        metric: metric.name(pair.selection),
        unit: metric.describe().unit,
        mask,
        value: None,
        interval: None,
        ci_of: String::new(),
        n: 0,
        status: Validity::Ok,
        reason: String::new(),
        formula: metric.describe().formula.to_owned(),
    };
    let broken = values_not_finite(sides.candidate, pair.size_px[0]);
    if let Some(reason) = broken {
        (found.status, found.reason) = (Validity::Invalid, format!("candidate: {reason}"));
    } else if pixels.is_some_and(<[usize]>::is_empty) {
        (found.status, found.reason) = (Validity::Undefined, "no pixel in the mask".to_owned());
    } else if metric.describe().of == Compared::Radiance && sides.reference == sides.candidate {
        found.n = pixels.map_or(pair.pixel_count(), <[usize]>::len) as u64;
        (found.status, found.value) = (Validity::Identical, metric.describe().if_equal);
        found.reason = "the images are equal, nothing was computed".to_owned();
    } else {
        fill(&mut found, pair.answer(metric, sides, pixels));
        if let (Validity::Ok, None, Some(value)) = (found.status, found.interval, found.value) {
            match spread::interval(pair, metric, sides, pixels, value) {
                Ok(interval) => found.interval = Some(interval),
                Err(reason) => found.ci_of = format!("none: {reason}"),
            }
            if found.interval.is_some() {
                found.ci_of = spread::SOURCE.to_owned();
            }
        }
    }
    Ok(found)
}

/// The layer that a metric compares, or why the pair does not have it.
fn sides<'a>(pair: &Pair<'a>, metric: Metric) -> Result<Sides<'a>, &'static str> {
    if !metric.takes(pair.selection.encoding) {
        return Err("it is not defined for this encoding");
    }
    if metric == Metric::MseCorrected && pair.variance.is_none() {
        return Err("the reference carries no variance: there is no noise to subtract");
    }
    match metric.describe().of {
        Compared::Exit => pair.exit.ok_or("no exit layer on both sides"),
        Compared::Radiance => pair.radiance.ok_or("no radiance layer on both sides"),
    }
}

/// Writes an answer down; what is not a finite number has none.
fn fill(found: &mut Measurement, answer: Answer) {
    match answer {
        Answer::Value(value, n) if value.is_finite() => (found.value, found.n) = (Some(value), n),
        Answer::Corrected(error, n) => {
            (found.value, found.n, found.interval) =
                (Some(error.corrected), n, Some(error.interval));
            found.ci_of = "the variance layer of the reference".to_owned();
        }
        Answer::Value(value, _) => {
            found.status = Validity::Undefined;
            found.reason = format!("it overflows to {value}");
        }
        Answer::Endless => {
            found.status = Validity::Identical;
            found.reason = "the judged pixels are equal".to_owned();
        }
        Answer::Undefined(reason) => (found.status, found.reason) = (Validity::Undefined, reason),
    }
}
