//! Rows of results: errors against the truth, times, and counts.

use crate::Error;
use crate::jobs::Made;
use crate::metric::{Candidate, Encoding, Exposures, Judgement, Mask, Reference, Selection, judge};
use crate::results::{NotDone, RESULT_SCHEMA, ResultRow, RowKind};
use scenes::layer::flag;
use scenes::rendering::{Pass, TimeSource};
use scenes::{LayerName, Scene};

/// The truth about a scene, and how images of it are judged.
pub(super) struct Judge<'a> {
    truth: &'a Made,
    selection: Selection,
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

    /// Everything measured about an image, and the metrics it does not have.
    /// What all its rows share comes from `common`.
    pub(super) fn rows(
        &self,
        made: &Made,
        common: &ResultRow,
    ) -> Result<(Vec<ResultRow>, Vec<NotDone>), Error> {
        let common = ResultRow { reference_id: self.truth.id.to_string(), ..common.clone() };
        let (truth, candidate) = (Reference(&self.truth.layers), Candidate(&made.layers));
        let Judgement { measurements, left_out, .. } = judge(truth, candidate, &self.selection)?;
        let mut rows: Vec<_> = measurements.iter().map(|found| found.row(&common)).collect();
        rows.extend(times(&made.facts.passes, &common));
        rows.extend(counts(made, &common));
        Ok((rows, left_out))
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
