//! The runs of a study as a report lists them, and what it says of each.

use super::numbers::Numbers;
use crate::metric::Metric;
use crate::results::{REFERENCE, ResultRow, Run, Study};

/// Metrics of the verdict table: figures of merit first.
pub(super) const MERITS: [(Metric, &str, &str); 6] = [
    (Metric::ExitAngleMedian, "exit angle, median", "°"),
    (Metric::ExitAngleP95, "95th percentile", "°"),
    (Metric::ExitWithin1Deg, "within 1°", "%"),
    (Metric::RelMseTrimmed, "relMSE ε=0.01, trimmed", ""),
    (Metric::WorstThousandth, "worst 0.1 % carry", "%"),
    (Metric::HdrFlip, "FLIP", ""),
];

/// Methods in order of first appearance: their place is their style, whatever their
/// settings.
pub(super) fn styles(study: &Study) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for run in study.runs.iter().filter(|run| run.method != REFERENCE) {
        if !names.contains(&run.method) {
            names.push(run.method.clone());
        }
    }
    names
}

/// Method id, and the parameters in which runs of it on one scene differ.
pub(super) fn display_name(study: &Study, run: &Run) -> String {
    study.name_of(run)
}

/// Runs of the approximations on a scene, in the order of the study.
pub(super) fn methods_of<'a>(study: &'a Study, scene: &str) -> Vec<&'a Run> {
    study.runs.iter().filter(|run| run.scene == scene && run.method != REFERENCE).collect()
}

/// The row of a metric over the whole image.
pub(super) fn find<'a>(numbers: &Numbers<'a>, run: &Run, metric: Metric) -> Option<&'a ResultRow> {
    numbers.find(run, metric.describe().name)
}
