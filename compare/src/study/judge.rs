//! Rows of results: errors against the truth, times, and counts.

use crate::Error;
use crate::metric::{
    Candidate, Encoding, Exposures, Judgement, Mask, Measurement, Metric, Reference, Selection,
    judge,
};
use crate::results::{NotDone, RESULT_SCHEMA, ResultRow, RowKind, with_all_kept};
use crate::study::jobs::Made;
use scenes::layer::flag;
use scenes::rendering::{Pass, TimeSource};
use scenes::{LayerName, Scene};

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
    pub(super) fn new(scene: &Scene, truth: &'a Made) -> Self {
        let mut selection = Selection::all(Encoding::Linear);
        selection.masks = vec![Mask::All, Mask::Object];
        let pinned = scene.judgement.flip_exposures;
        selection.flip_exposures = pinned
            .map(|(start, stop, count)| Exposures { start, stop, count: count as usize })
            .or_else(|| Exposures::of(&truth.layers.get(&LayerName::Radiance)?.data));
        Self { truth, selection }
    }

    /// Exposures at which images of the scene are compared: start, stop, count.
    pub(super) fn exposures(&self) -> Option<(f64, f64, u32)> {
        self.selection.flip_exposures.map(|e| (e.start, e.stop, e.count as u32))
    }

    /// Everything measured about an image. What all its rows share comes from
    /// `common`.
    pub(super) fn judged(&self, made: &Made, common: &ResultRow) -> Result<Judged, Error> {
        let Judgement { measurements, left_out, flip_map } =
            judge(Reference(&self.truth.layers), Candidate(&made.layers), &self.selection)?;
        Ok(Judged { rows: self.rows(&measurements, made, common), left_out, flip_map })
    }

    /// The cheap errors of an image of the exact renderer's own curve: FLIP
    /// and SSIM would take longer than the image, and nobody plots them.
    pub(super) fn curve_rows(
        &self,
        made: &Made,
        common: &ResultRow,
    ) -> Result<Vec<ResultRow>, Error> {
        let metrics = vec![Metric::RelMse, Metric::RelMseTrimmed, Metric::Bias, Metric::Rmse];
        let selection = Selection { metrics, masks: vec![Mask::All], ..self.selection.clone() };
        let found = judge(Reference(&self.truth.layers), Candidate(&made.layers), &selection)?;
        Ok(self.rows(&found.measurements, made, common))
    }

    fn rows(&self, found: &[Measurement], made: &Made, common: &ResultRow) -> Vec<ResultRow> {
        let common = ResultRow { reference_id: self.truth.id.to_string(), ..common.clone() };
        let mut rows: Vec<_> = found.iter().map(|found| found.row(&common)).collect();
        rows.extend(times(&made.facts.passes, &common));
        rows.extend(counts(made, &common));
        rows
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
        let times: Vec<f64> =
            all.filter(|time| time.source == clock).map(|time| time.milliseconds).collect();
        (!times.is_empty()).then(|| ResultRow {
            kind: RowKind::Time,
            unit: "ms".to_owned(),
            ..number(name, times.iter().sum(), common)
        })
    };
    clocks.into_iter().filter_map(row).collect()
}

/// The same of a frame in which nothing was left out.
pub(super) fn times_with_all_kept(passes: &[Pass], common: &ResultRow) -> Vec<ResultRow> {
    let mut rows = times(passes, common);
    rows.iter_mut().for_each(|row| row.metric = with_all_kept(&row.metric));
    rows
}

/// Work done, and pixels by flag.
fn counts(made: &Made, common: &ResultRow) -> Vec<ResultRow> {
    let count = |name: &str, count: u64| ResultRow {
        kind: RowKind::Count,
        ..number(name, count as f64, common)
    };
    let counters = made.facts.counters.iter().map(|(name, value)| count(name, *value));
    let mut rows: Vec<_> = counters.collect();
    if let Some(layer) = made.layers.get(&LayerName::Flags) {
        for (name, bit) in flag::ALL {
            let flagged = layer.data.iter().filter(|flags| **flags as u32 & bit != 0).count();
            rows.push(count(&format!("pixels_{name}"), flagged as u64));
        }
    }
    rows
}

fn number(metric: &str, value: f64, common: &ResultRow) -> ResultRow {
    ResultRow {
        schema: RESULT_SCHEMA.to_owned(),
        metric: metric.to_owned(),
        value: Some(value),
        ..common.clone()
    }
}
