//! The plots of one scene and what is said under them.

use super::numbers::{Numbers, usable};
use super::page::PlotView;
use super::plot::{Plot, Point};
use super::runs::{display_name, find};
use crate::metric::Metric;
use crate::results::{Run, SceneEntry, Study};

/// Error against time: the image, the image without its glints, the exit angle.
pub(super) fn plots(
    entry: &SceneEntry,
    study: &Study,
    runs: &[&Run],
    numbers: &Numbers,
    styles: &[String],
) -> Vec<PlotView> {
    let mut plots = Vec::new();
    for (metric, kind, label) in [
        (Metric::RelMse, "image", "relMSE ε=0.01 (image)"),
        (Metric::RelMseTrimmed, "image-trimmed", "relMSE without the worst 0.1 % of pixels"),
        (Metric::ExitAngleMedian, "exit-angle", "median exit-angle error, degrees"),
    ] {
        let points = runs.iter().filter_map(|run| {
            let row = find(numbers, run, metric)?;
            let name = display_name(study, run);
            Some(Point {
                time_ms: numbers.time(run, &study.time_metric).and_then(usable)?,
                error: usable(row)?,
                interval: row.ci_lo.zip(row.ci_hi),
                style: styles.iter().position(|known| *known == name).unwrap_or(0),
                name,
            })
        });
        let plot = Plot {
            title: format!("{}: {label} against time", entry.name),
            error_label: label.to_owned(),
            time_label: "milliseconds per frame".to_owned(),
            points: points.collect(),
            curve: numbers.reference_curve(&entry.name, metric.describe().name),
        };
        let svg = plot.svg();
        if !svg.is_empty() {
            plots.push(PlotView { kind, caption: caption(&plot), svg });
        }
    }
    plots
}

fn caption(plot: &Plot) -> String {
    let mut caption = String::from("Lower left is better. Dotted: methods that no other beats.");
    if !plot.curve.is_empty() {
        caption.push_str(
            " Line: the exact CPU renderer's wall time, with samples disjoint from the truth's.",
        );
    }
    let missing = plot.not_shown();
    if !missing.is_empty() {
        caption.push_str(&format!(" Not on a logarithmic axis (zero): {}.", missing.join(", ")));
    }
    caption
}
