//! From rows and image files to what a report shows.

use super::number::{bytes, digits, duration};
use super::numbers::{Numbers, usable};
use super::page::{Cell, MethodView, Page, SceneView};
use super::pictures::SceneImages;
use super::plot::marker_image;
use super::ranking::{self, Ranked};
use super::runs::{MERITS, display_name, find, methods_of, styles};
use super::{Options, ReportError, citations, folder, scene_plots, verdict, viewer};
use crate::metric::{Better, Mask, Metric};
use crate::results::{REFERENCE, ResultRow, RowKind, Run, SceneEntry, Study, Validity, saved_ms};
use crate::support::repeats::stretches;
use rayon::prelude::*;
use scenes::rendering::Pass;
use std::path::Path;

/// Reads the images, makes every picture and its file, and fills a page.
///
/// One scene after the other per thread: a study's images together may be
/// larger than memory.
pub(super) fn assemble(
    directory: &Path,
    study: Study,
    rows: &[ResultRow],
    options: Options,
) -> Result<Page, ReportError> {
    let numbers = Numbers::new(rows);
    let styles = styles(&study);
    let factor = viewer::shrinking(&study, options.data_in_page_bytes);
    let full = factor > 1 && !options.single_file;
    let one_scene = |(index, entry): (usize, &SceneEntry)| {
        let images = SceneImages::read(directory, &study, entry)?;
        let mut view = scene_view(index, entry, &study, &numbers, &styles);
        view.ev = images.ev;
        view.data = viewer::data(&view, &images, factor);
        if full {
            viewer::write_full(directory, &view, &images)?;
        }
        folder::place(directory, &mut view, images.pictures())?;
        Ok(view)
    };
    let scenes: Result<Vec<SceneView>, ReportError> =
        study.scenes.par_iter().enumerate().map(one_scene).collect();
    let scenes = scenes?;
    Ok(Page {
        headline: verdict::sentences(&study, &numbers),
        columns: MERITS.map(|(metric, head, unit)| (head, unit, arrow(metric))).to_vec(),
        methods: citations::methods(&styles),
        metrics: descriptions(),
        viewer_json: viewer::contents(&scenes, factor, full),
        size_note: viewer::note(factor, options.single_file),
        scenes,
        study,
    })
}

fn scene_view(
    index: usize,
    entry: &SceneEntry,
    study: &Study,
    numbers: &Numbers,
    styles: &[String],
) -> SceneView {
    let runs = methods_of(study, &entry.name);
    let mut methods: Vec<MethodView> = runs
        .iter()
        .map(|run| method_view(run, display_name(study, run), numbers, study, styles))
        .collect();
    mark_best(&mut methods, &runs, entry, numbers, study);
    let reference_run =
        study.runs.iter().find(|run| run.scene == entry.name && run.method == REFERENCE);
    SceneView {
        entry: entry.clone(),
        index,
        reference_facts: reference_run.map(facts).unwrap_or_default(),
        plots: scene_plots::plots(entry, study, numbers, styles),
        methods,
        ..SceneView::default()
    }
}

fn facts(run: &Run) -> Vec<String> {
    let counters = run.counters.iter().map(|(name, value)| format!("{name} = {value}"));
    run.parameters.iter().map(|(n, v)| format!("{n} = {v}")).chain(counters).collect()
}

fn method_view(
    run: &Run,
    name: String,
    numbers: &Numbers,
    study: &Study,
    styles: &[String],
) -> MethodView {
    let style = styles.iter().position(|known| *known == run.method).unwrap_or(0);
    let memory = match run.plan.bytes() {
        0 => run.counters.get("bytes").copied().unwrap_or(0),
        planned => planned,
    };
    let time = numbers.time(run, &study.time_metric);
    let passes = stretches(&run.passes).into_iter().map(|(repeated, passes)| {
        let named = |pass: &Pass| {
            let times = pass.times.iter().map(|t| duration(t.milliseconds));
            (pass.name.clone(), times.collect::<Vec<_>>().join(", "))
        };
        (repeated, passes.iter().map(named).collect())
    });
    let left_out = run.plan.left_out.iter().map(|left| {
        let saved = if left.saves_bytes > 0 { bytes(left.saves_bytes) } else { String::new() };
        (left.what.clone(), left.reason.clone(), saved)
    });
    MethodView {
        marker: marker_image(style),
        cells: MERITS.map(|(metric, ..)| cell(metric, find(numbers, run, metric))).to_vec(),
        time: Cell {
            text: time.and_then(usable).map_or("—".to_owned(), duration),
            spread: time
                .and_then(|row| row.ci_lo.zip(row.ci_hi))
                .map(|(low, high)| half_width((low, high), 1.0))
                .unwrap_or_default(),
            note: time.map(|row| format!("{}, {} frames", row.metric, row.n)).unwrap_or_default(),
            ..Cell::default()
        },
        memory: if memory > 0 { bytes(memory) } else { "—".to_owned() },
        passes: passes.collect(),
        passes_count: run.passes.len(),
        left_out: left_out.collect(),
        saved_time: saved_ms(numbers.of(run).iter().copied(), &study.time_metric)
            .map_or(String::new(), duration_saved),
        unsupported: run
            .plan
            .unsupported
            .iter()
            .map(|u| (u.what.clone(), u.instead.clone()))
            .collect(),
        numbers: numbers.of(run).iter().map(|row| number_line(row)).collect(),
        metrics_left_out: run.metrics_left_out.clone(),
        parameters: run.parameters.iter().map(|(n, v)| format!("{n} = {v}")).collect(),
        name,
        pictures: None,
    }
}

/// A difference of two measured times may be of either sign.
fn duration_saved(saved_ms: f64) -> String {
    let sign = if saved_ms < 0.0 { "+" } else { "−" };
    format!("{sign}{}", duration(saved_ms.abs()))
}

/// Name, value, unit, pixels and note of a row.
fn number_line(row: &ResultRow) -> [String; 5] {
    let mask = if row.mask == Mask::Object { ", object only" } else { "" };
    let value = match (row.value, row.kind) {
        (Some(value), RowKind::Count) => format!("{value}"),
        (Some(value), _) => digits(value),
        (None, _) => "—".to_owned(),
    };
    let interval = match (row.ci_lo, row.ci_hi) {
        (Some(low), Some(high)) => {
            format!("95 %: {} to {} ({}) ", digits(low), digits(high), row.ci_of)
        }
        _ if row.ci_of.is_empty() => String::new(),
        _ => format!("no interval, {} ", row.ci_of.trim_start_matches("none: ")),
    };
    let note = match row.status {
        Validity::Ok => String::new(),
        Validity::Identical => "identical: ".to_owned(),
        Validity::Undefined => "undefined: ".to_owned(),
        Validity::Invalid => "invalid: ".to_owned(),
    };
    [
        format!("{}{mask}", row.metric),
        value,
        row.unit.clone(),
        row.n.to_string(),
        format!("{interval}{note}{}", row.reason),
    ]
}

/// ` ± 0.2` of an interval; empty where it has no width.
fn half_width((low, high): (f64, f64), scale: f64) -> String {
    let half = 0.5 * scale * (high - low);
    if half > 0.0 { format!(" ± {}", digits(half)) } else { String::new() }
}

fn cell(metric: Metric, row: Option<&ResultRow>) -> Cell {
    let Some(row) = row else {
        let note = "not measured".to_owned();
        return Cell { text: "—".to_owned(), note, ..Cell::default() };
    };
    let in_percent = matches!(metric, Metric::ExitWithin1Deg | Metric::WorstThousandth);
    let scale = if in_percent { 100.0 } else { 1.0 };
    match usable(row) {
        Some(value) => {
            let full = match (row.ci_lo, row.ci_hi) {
                (Some(low), Some(high)) => format!("{value} ({low} to {high}), n = {}", row.n),
                _ => format!("{value}, n = {}", row.n),
            };
            let spread = row.ci_lo.zip(row.ci_hi).map(|ends| half_width(ends, scale));
            let spread = spread.unwrap_or_default();
            Cell { text: digits(scale * value), spread, note: full, ..Cell::default() }
        }
        None => Cell {
            text: if row.status == Validity::Invalid { "invalid" } else { "—" }.to_owned(),
            note: row.reason.clone(),
            invalid: row.status == Validity::Invalid,
            ..Cell::default()
        },
    }
}

/// Marks the best values of each column and the fastest frames, where more than one method
/// was measured; a column that ranks nothing says so.
fn mark_best(
    views: &mut [MethodView],
    runs: &[&Run],
    entry: &SceneEntry,
    numbers: &Numbers,
    study: &Study,
) {
    if runs.len() < 2 {
        return;
    }
    for (column, (metric, ..)) in MERITS.into_iter().enumerate() {
        let row = |run: &&Run| find(numbers, run, metric).and_then(Ranked::of);
        let values: Vec<_> = runs.iter().map(row).collect();
        let floor = numbers.exact_error(entry, metric, runs[0].positions);
        let marks = ranking::best(metric, &values, floor);
        let unranked = !marks.contains(&true) && values.iter().any(Option::is_some);
        for (view, best) in views.iter_mut().zip(marks) {
            view.cells[column].best = best;
            if let (true, Some(floor)) = (unranked, floor) {
                view.cells[column].note.push_str(&format!(
                    "; ranks nothing here: the exact renderer itself is off by {} with other \
                     samples of the pixel",
                    digits(floor)
                ));
            }
        }
    }
    let time = |run: &&Run| numbers.time(run, &study.time_metric).and_then(Ranked::of);
    let times: Vec<_> = runs.iter().map(time).collect();
    // Any error that is the better the lower ranks as a time does.
    let marks = ranking::best(Metric::Rmse, &times, None);
    views.iter_mut().zip(marks).for_each(|(view, best)| view.time.best = best);
}

/// Which way is better.
fn arrow(metric: Metric) -> &'static str {
    match metric.describe().better {
        Better::Lower => "↓",
        Better::Higher => "↑",
        Better::NearZero => "→ 0",
        Better::Neither => "",
    }
}

fn descriptions() -> Vec<[String; 6]> {
    let lines = Metric::ALL.iter().map(|metric| {
        let d = metric.describe();
        let better = match d.better {
            Better::Lower => "lower",
            Better::Higher => "higher",
            Better::NearZero => "near zero",
            Better::Neither => "neither",
        };
        [d.name, d.formula, d.unit, d.range, better, d.source].map(str::to_owned)
    });
    lines.collect()
}
