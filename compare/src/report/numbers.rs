//! The rows of a study, found by scene, run and metric.

use crate::metric::{Better, Mask, Metric};
use crate::results::{REFERENCE, ResultRow, RowKind, Run, SceneEntry, Validity};
use std::collections::BTreeMap;

/// Rows by run, in file order.
pub(super) struct Numbers<'a> {
    /// All of them.
    pub(super) rows: &'a [ResultRow],
    by_run: BTreeMap<&'a str, Vec<&'a ResultRow>>,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(rows: &'a [ResultRow]) -> Self {
        let mut by_run: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for row in rows {
            by_run.entry(row.id.as_str()).or_default().push(row);
        }
        Self { rows, by_run }
    }

    /// All rows of a run.
    pub(super) fn of(&self, run: &Run) -> &[&'a ResultRow] {
        self.by_run.get(run.id.as_str()).map_or(&[], Vec::as_slice)
    }

    /// The row of a metric over the whole image.
    pub(super) fn find(&self, run: &Run, metric: &str) -> Option<&'a ResultRow> {
        self.of(run).iter().copied().find(|row| row.metric == metric && row.mask == Mask::All)
    }

    /// What the exact renderer itself is off by with at most k x k other positions in each
    /// pixel, the most that were tried; `None` where its curve has no such metric.
    pub(super) fn exact_error(&self, entry: &SceneEntry, metric: Metric, k: u32) -> Option<f64> {
        let own = |row: &&ResultRow| {
            row.method == REFERENCE
                && row.kind == RowKind::Error
                && row.metric == metric.describe().name
                && row.mask == Mask::All
                && row.positions <= k
                && entry.holds(row)
        };
        self.rows.iter().filter(own).max_by_key(|row| row.positions).and_then(usable)
    }

    /// Time of a frame by the study's clock, else by the wall, else by any.
    pub(super) fn time(&self, run: &Run, clock: &str) -> Option<&'a ResultRow> {
        let times = || self.of(run).iter().copied().filter(|row| row.kind == RowKind::Time);
        times()
            .find(|row| row.metric == clock)
            .or_else(|| times().find(|row| row.metric == "time_wall_ms"))
            .or_else(|| times().next())
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
        Better::Neither => false,
    }
}
