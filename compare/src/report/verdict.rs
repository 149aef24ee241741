//! The verdict in sentences: who wins, by how much, at what cost, against what.

use super::number::{digits, duration};
use super::numbers::{Numbers, is_better, usable};
use super::runs::{display_name, methods_of};
use crate::metric::Metric;
use crate::results::{Run, Study};
use std::collections::BTreeMap;

/// Two or three sentences for the first screen.
pub(super) fn sentences(study: &Study, numbers: &Numbers) -> Vec<String> {
    let mut sentences = Vec::new();
    let metric = Metric::ExitAngleMedian;
    let measured = |run: &Run| numbers.find(run, metric.describe().name).and_then(usable);
    // Per winner: its scenes, its errors and its times there.
    let mut wins: BTreeMap<String, Vec<(f64, Option<f64>)>> = BTreeMap::new();
    let mut scenes = 0;
    for scene in &study.scenes {
        let runs = methods_of(study, &scene.name);
        let ranked = runs.iter().filter_map(|run| Some((measured(run)?, *run)));
        let best = ranked.reduce(|a, b| if is_better(metric, b.0, a.0) { b } else { a });
        let Some((error, run)) = best else { continue };
        scenes += 1;
        let time = numbers.time(run, &study.time_metric).and_then(usable);
        wins.entry(display_name(study, run)).or_default().push((error, time));
    }
    let mut order: Vec<_> = wins.iter().collect();
    order.sort_by_key(|(_, won)| std::cmp::Reverse(won.len()));
    for (place, (name, won)) in order.iter().take(2).enumerate() {
        let errors = span(won.iter().map(|w| w.0), |v| format!("{}°", digits(v)));
        let cost = span(won.iter().filter_map(|w| w.1), duration);
        let cost = if cost.is_empty() { cost } else { format!(", {cost} per frame") };
        let verb = if place == 0 { "sends light in the best direction" } else { "does" };
        sentences.push(format!(
            "{name} {verb} in {} of {scenes} scenes: median error {errors}{cost}.",
            won.len()
        ));
    }
    let clock = if study.software {
        "is a CPU in the role of a GPU, so times compare methods with each other, not with hardware"
    } else {
        "is a GPU"
    };
    sentences.push(format!(
        "Truth is snell's own ray tracer in 64-bit arithmetic; the adapter, {}, {clock}.",
        if study.adapter.is_empty() { "not named" } else { &study.adapter }
    ));
    sentences
}

/// `a` or `a to b`.
fn span(values: impl Iterator<Item = f64>, print: impl Fn(f64) -> String) -> String {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    match (low <= high, print(low) == print(high)) {
        (false, _) => String::new(),
        (true, true) => print(low),
        (true, false) => format!("{} to {}", print(low), print(high)),
    }
}
