//! The plots of one scene and what is said under them.

use super::numbers::Numbers;
use super::page::PlotView;
use super::plot::{Front, Plot, Point};
use crate::metric::Metric;
use crate::results::curves::{Curve, curves};
use crate::results::{REFERENCE, SceneEntry, Study};

/// Error against time: the image, the image without its glints, the exit angle.
pub(super) fn plots(
    entry: &SceneEntry,
    study: &Study,
    numbers: &Numbers,
    styles: &[String],
) -> Vec<PlotView> {
    let mut plots = Vec::new();
    for (metric, kind, label) in [
        (Metric::RelMse, "image", "relMSE ε=0.01 (image)"),
        (Metric::RelMseTrimmed, "image-trimmed", "relMSE without the worst 0.1 % of pixels"),
        (Metric::ExitAngleMedian, "exit-angle", "median exit-angle error, degrees"),
    ] {
        let curves = curves(study, entry, numbers.rows, metric.describe().name);
        let (exact, methods): (Vec<Curve>, Vec<Curve>) =
            curves.into_iter().partition(|curve| curve.method == REFERENCE);
        let exact = exact.iter().flat_map(|curve| &curve.points);
        let plot = Plot {
            title: format!("{}: {label} against time", entry.name),
            error_label: label.to_owned(),
            time_label: "milliseconds per frame".to_owned(),
            points: methods.iter().flat_map(|curve| points(curve, styles)).collect(),
            fronts: methods.iter().filter_map(|curve| front(curve, styles)).collect(),
            curve: exact.map(|point| (point.time_ms, point.error)).collect(),
        };
        let svg = plot.svg();
        if !svg.is_empty() {
            plots.push(PlotView { kind, caption: caption(&plot), svg });
        }
    }
    plots
}

fn style(curve: &Curve, styles: &[String]) -> usize {
    styles.iter().position(|known| *known == curve.method).unwrap_or(0)
}

/// Every setting of a method; of several only the most exact carries a label.
fn points(curve: &Curve, styles: &[String]) -> Vec<Point> {
    let labelled = curve.front().last().map(|point| (*point).clone());
    let point = |point: &crate::results::curves::Point| Point {
        name: format!("{} {}", curve.method, point.setting).trim_end().to_owned(),
        labelled: labelled.as_ref() == Some(point),
        time_ms: point.time_ms,
        error: point.error,
        interval: point.interval,
        style: style(curve, styles),
    };
    curve.points.iter().map(point).collect()
}

/// The settings of a method that no other of it beats, if it has several.
fn front(curve: &Curve, styles: &[String]) -> Option<Front> {
    let front = curve.front();
    let points = front.iter().map(|point| (point.time_ms, point.error)).collect();
    (front.len() > 1).then(|| Front { points, style: style(curve, styles) })
}

fn caption(plot: &Plot) -> String {
    let mut caption = String::from("Lower left is better. Dotted: methods that no other beats.");
    if !plot.fronts.is_empty() {
        caption.push_str(" Coloured lines: settings of a method that no other of it beats.");
    }
    if !plot.curve.is_empty() {
        caption.push_str(
            " Line: the exact CPU renderer's wall time, with samples disjoint from the truth's.",
        );
    }
    if plot.error_label.starts_with("relMSE") {
        caption
            .push_str(" Errors are of what the timed frame draws, against the pixel's integral.");
    }
    let missing = plot.not_shown();
    if !missing.is_empty() {
        caption.push_str(&format!(" Not on a logarithmic axis (zero): {}.", missing.join(", ")));
    }
    caption
}
