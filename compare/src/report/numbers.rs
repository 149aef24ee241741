//! The rows of a study, found by scene, run and metric.

use crate::metric::{Better, Mask, Metric};
use crate::results::{REFERENCE, ResultRow, RowKind, Run, Validity};
use std::collections::BTreeMap;

/// Rows by scene and run, in file order.
pub(super) struct Numbers<'a> {
    by_scene: BTreeMap<&'a str, BTreeMap<&'a str, Vec<&'a ResultRow>>>,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(rows: &'a [ResultRow]) -> Self {
        let mut by_scene: BTreeMap<_, BTreeMap<_, Vec<_>>> = BTreeMap::new();
        for row in rows {
            let scene = by_scene.entry(row.scene.as_str()).or_default();
            scene.entry(row.id.as_str()).or_default().push(row);
        }
        Self { by_scene }
    }

    /// All rows of a run.
    pub(super) fn of(&self, run: &Run) -> &[&'a ResultRow] {
        let scene = self.by_scene.get(run.scene.as_str());
        scene.and_then(|runs| runs.get(run.id.as_str())).map_or(&[], Vec::as_slice)
    }

    /// The row of a metric over the whole image.
    pub(super) fn find(&self, run: &Run, metric: &str) -> Option<&'a ResultRow> {
        self.of(run).iter().copied().find(|row| row.metric == metric && row.mask == Mask::All)
    }

    /// Time of a frame by the study's clock, else by the wall, else by any.
    pub(super) fn time(&self, run: &Run, clock: &str) -> Option<&'a ResultRow> {
        let times = || self.of(run).iter().copied().filter(|row| row.kind == RowKind::Time);
        times()
            .find(|row| row.metric == clock)
            .or_else(|| times().find(|row| row.metric == "time_wall_ms"))
            .or_else(|| times().next())
    }

    /// Error and time of the exact renderer at growing effort, by time.
    pub(super) fn reference_curve(&self, scene: &str, metric: &str) -> Vec<(f64, f64)> {
        let runs = self.by_scene.get(scene).into_iter().flat_map(BTreeMap::values);
        let mut curve: Vec<(f64, f64)> = runs
            .filter_map(|rows| {
                let own = || rows.iter().filter(|row| row.method == REFERENCE);
                let error = own().find(|row| row.metric == metric && row.mask == Mask::All)?;
                let time = own().find(|row| row.metric == "time_wall_ms")?;
                Some((usable(time)?, usable(error)?))
            })
            .collect();
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        curve
    }
}

/// The value of a row, if it may be used.
pub(super) fn usable(row: &ResultRow) -> Option<f64> {
    row.value.filter(|_| matches!(row.status, Validity::Ok | Validity::Identical))
}

/// True if `a` is better than `b` by the direction of the metric.
pub(super) fn is_better(metric: Metric, a: f64, b: f64) -> bool {
    match metric.describe().better {
        Better::Lower => a < b,
        Better::Higher => a > b,
        Better::NearZero => a.abs() < b.abs(),
    }
}
