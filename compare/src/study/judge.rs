//! Rows of results: errors against the truth, times, and counts.

use crate::Error;
use crate::metric::{
    Candidate, Encoding, Exposures, Judgement, Mask, Metric, Reference, Selection, judge,
};
use crate::results::{NotDone, RESULT_SCHEMA, ResultRow, RowKind, with_all_kept};
use crate::study::jobs::{Exact, Made};
use crate::support::statistics::{FEWEST, Interval, median_interval};
use scenes::layer::flag;
use scenes::rendering::{Pass, Time, TimeSource};
use scenes::{LayerName, Layers, Scene};

/// The truth about a scene, and how images of it are judged.
pub(super) struct Judge<'a> {
    truth: &'a Made,
    selection: Selection,
}

/// What was measured about an image.
pub(super) struct Judged {
    /// Errors, times and counts.
    pub(super) rows: Vec<ResultRow>,
    /// Metrics that the image does not have.
    pub(super) left_out: Vec<NotDone>,
    /// FLIP of each pixel, if it was measured.
    pub(super) flip_map: Option<Vec<f64>>,
}

impl<'a> Judge<'a> {
    /// `scene`: as it is written, without numbers that a sweep sets in it, so that
    /// FLIP compares at the same exposures wherever the scene is judged.
    pub(super) fn new(scene: &Scene, truth: &'a Made) -> Result<Self, Error> {
        let exposures = match scene.judgement.flip_exposures {
            Some(pinned) => Some(pinned),
            None => Exposures::of(&Exact::glance(scene)?)
                .map(|found| (found.start, found.stop, found.count as u32)),
        };
        Ok(Self::at(exposures, truth))
    }

    /// Judges at exposures that were chosen before.
    pub(super) fn at(exposures: Option<(f64, f64, u32)>, truth: &'a Made) -> Self {
        let mut selection = Selection::all(Encoding::Linear);
        selection.masks = vec![Mask::All, Mask::Object];
        let read = |(start, stop, count): (f64, f64, u32)| Exposures {
            start,
            stop,
            count: count as usize,
        };
        selection.flip_exposures = exposures.map(read);
        Self { truth, selection }
    }

    /// Exposures at which images of the scene are compared: start, stop, count.
    pub(super) fn exposures(&self) -> Option<(f64, f64, u32)> {
        self.selection.flip_exposures.map(|e| (e.start, e.stop, e.count as u32))
    }

    /// Everything measured about an image. What all its rows share comes from
    /// `common`.
    pub(super) fn judged(&self, made: &Made, common: &ResultRow) -> Result<Judged, Error> {
        let mut judged = self.judged_against(&self.truth.layers, &made.layers, common)?;
        judged.rows.extend(counts(made, &self.named(common)));
        Ok(judged)
    }

    /// The errors of layers against a truth of the caller's.
    pub(super) fn judged_against(
        &self,
        truth: &Layers,
        layers: &Layers,
        common: &ResultRow,
    ) -> Result<Judged, Error> {
        let Judgement { measurements, left_out, flip_map } =
            judge(Reference(truth), Candidate(layers), &self.selection)?;
        let common = self.named(common);
        let rows = measurements.iter().map(|found| found.row(&common)).collect();
        Ok(Judged { rows, left_out, flip_map })
    }

    /// The cheap errors of an image of the exact renderer's own curve: FLIP
    /// and SSIM would take longer than the image, and nobody plots them.
    pub(super) fn curve_rows(
        &self,
        made: &Made,
        common: &ResultRow,
    ) -> Result<Vec<ResultRow>, Error> {
        let mut rows = self.pixel_integral_rows(&made.layers, common)?;
        let common = self.named(common);
        rows.extend(times(&made.facts.passes, &common));
        rows.extend(counts(made, &common));
        Ok(rows)
    }

    /// The cheap errors of an image that was drawn at fewer positions than the
    /// truth: what its pixels miss of their integral counts.
    pub(super) fn pixel_integral_rows(
        &self,
        layers: &Layers,
        common: &ResultRow,
    ) -> Result<Vec<ResultRow>, Error> {
        let metrics = vec![Metric::RelMse, Metric::RelMseTrimmed, Metric::Bias, Metric::Rmse];
        let selection = Selection { metrics, masks: vec![Mask::All], ..self.selection.clone() };
        let found = judge(Reference(&self.truth.layers), Candidate(layers), &selection)?;
        let common = self.named(common);
        Ok(found.measurements.iter().map(|found| found.row(&common)).collect())
    }

    /// Rows of an image name the truth that it was compared with.
    fn named(&self, common: &ResultRow) -> ResultRow {
        ResultRow { reference_id: self.truth.id.to_string(), ..common.clone() }
    }
}

/// Durations of the whole frame, one row per clock.
pub(super) fn times(passes: &[Pass], common: &ResultRow) -> Vec<ResultRow> {
    let clocks = [
        (TimeSource::Timestamp, "time_timestamp_ms"),
        (TimeSource::Wall, "time_wall_ms"),
        (TimeSource::Cpu, "time_cpu_ms"),
    ];
    let row = |(clock, name): (TimeSource, &str)| {
        let all = passes.iter().flat_map(|pass| &pass.times);
        let times: Vec<&Time> = all.filter(|time| time.source == clock).collect();
        (!times.is_empty()).then(|| of_frame(&times, &number(name, 0.0, common)))
    };
    clocks.into_iter().filter_map(row).collect()
}

/// The time of a frame whose passes took these, with the interval of its median.
fn of_frame(passes: &[&Time], named: &ResultRow) -> ResultRow {
    let row = ResultRow { kind: RowKind::Time, unit: "ms".to_owned(), ..named.clone() };
    let frames = passes.iter().map(|time| time.frames_ms.len()).min().unwrap_or(0);
    if frames == 0 {
        let value = Some(passes.iter().map(|time| time.milliseconds).sum());
        return ResultRow { value, n: 1, ci_of: "none: measured once".to_owned(), ..row };
    }
    let whole = |frame: usize| passes.iter().map(|time| time.frames_ms[frame]).sum();
    let frames_ms: Vec<f64> = (0..frames).map(whole).collect();
    let Interval { median, low, high } = median_interval(&frames_ms);
    let few = if frames < FEWEST { "; so few promise less than 95 %" } else { "" };
    ResultRow {
        value: Some(median),
        ci_lo: Some(low),
        ci_hi: Some(high),
        n: frames as u64,
        ci_of: format!("order statistics of {frames} frames{few}"),
        ..row
    }
}

/// The same of a frame in which nothing was left out.
pub(super) fn times_with_all_kept(passes: &[Pass], common: &ResultRow) -> Vec<ResultRow> {
    let mut rows = times(passes, common);
    rows.iter_mut().for_each(|row| row.metric = with_all_kept(&row.metric));
    rows
}

/// Work done, and pixels by flag.
fn counts(made: &Made, common: &ResultRow) -> Vec<ResultRow> {
    let count = |name: &str, count: u64| count_row(name, count as f64, common);
    let counters = made.facts.counters.iter().map(|(name, value)| count(name, *value));
    let mut rows: Vec<_> = counters.collect();
    if let Some(layer) = made.layers.get(&LayerName::Flags) {
        for (name, bit, _) in flag::ALL {
            let flagged = layer.data.iter().filter(|flags| **flags as u32 & bit != 0).count();
            rows.push(count(&format!("pixels_{name}"), flagged as u64));
        }
    }
    rows
}

/// A deterministic count as a row.
pub(super) fn count_row(name: &str, count: f64, common: &ResultRow) -> ResultRow {
    let ci_of = "none: a count".to_owned();
    ResultRow { kind: RowKind::Count, ci_of, ..number(name, count, common) }
}

fn number(metric: &str, value: f64, common: &ResultRow) -> ResultRow {
    ResultRow {
        schema: RESULT_SCHEMA.to_owned(),
        metric: metric.to_owned(),
        value: Some(value),
        ..common.clone()
    }
}
