//! The verdict in sentences: what to use within which time, how wrong it is, where nothing
//! will do, and against what that was measured. It rests on the exit angle, which a few
//! bright pixels cannot turn.

use super::number::{digits, duration};
use super::numbers::Numbers;
use super::ranking::{self, Ranked};
use super::runs::{display_name, methods_of};
use crate::metric::Metric;
use crate::results::{Run, Study};
use std::collections::BTreeMap;

const METRIC: Metric = Metric::ExitAngleMedian;
/// A median exit angle that nobody sees, degrees.
const WILL_DO_DEG: f64 = 1.0;
/// Angles below this are as good as none in a mean of logarithms, degrees.
const SMALLEST_DEG: f64 = 1e-3;

/// Sentences for the first screen.
pub(super) fn sentences(study: &Study, numbers: &Numbers) -> Vec<String> {
    let scenes = Scenes::of(study, numbers);
    let mut sentences: Vec<String> = scenes.within_times();
    sentences.extend(scenes.best());
    sentences.extend(scenes.where_none_will_do());
    sentences.push(truth(study));
    sentences
}

/// One method in one scene.
#[derive(Clone, Copy)]
struct Found {
    angle_deg: Ranked,
    time_ms: Option<f64>,
}

/// Per scene, every method that has an exit angle.
struct Scenes(Vec<(String, Vec<(String, Found)>)>);

/// A method over all scenes.
struct Overall {
    name: String,
    /// The slowest of its scenes.
    time_ms: f64,
    /// Geometric mean over the scenes, with the 95 % interval of that.
    angle_deg: Ranked,
}

impl Scenes {
    fn of(study: &Study, numbers: &Numbers) -> Self {
        let angle = |run: &Run| numbers.find(run, METRIC.describe().name).and_then(Ranked::of);
        let found = |run: &&Run| {
            let time_ms = numbers.time(run, &study.time_metric).and_then(super::numbers::usable);
            Some((display_name(study, run), Found { angle_deg: angle(run)?, time_ms }))
        };
        let of_scene = |name: &str| methods_of(study, name).iter().filter_map(found).collect();
        let all = study.scenes.iter().map(|scene| (scene.name.clone(), of_scene(&scene.name)));
        Self(all.filter(|(_, methods): &(_, Vec<_>)| !methods.is_empty()).collect())
    }

    /// Methods that every scene has, by time.
    fn overall(&self) -> Vec<Overall> {
        let mut by_name: BTreeMap<&str, Vec<Found>> = BTreeMap::new();
        for (name, found) in self.0.iter().flat_map(|(_, methods)| methods) {
            by_name.entry(name).or_default().push(*found);
        }
        let everywhere = by_name.into_iter().filter(|(_, found)| found.len() == self.0.len());
        let mut all: Vec<Overall> = everywhere.filter_map(|(name, f)| overall(name, &f)).collect();
        all.sort_by(|a, b| a.time_ms.total_cmp(&b.time_ms));
        all
    }

    /// The cheapest, the middle and the best of the methods that no other beats.
    fn within_times(&self) -> Vec<String> {
        let mut front: Vec<Overall> = Vec::new();
        for method in self.overall() {
            // More time has to buy an error that can be told from what is had already.
            let better = front.last().is_none_or(|last| method.angle_deg.high < last.angle_deg.low);
            if better {
                front.push(method);
            }
        }
        let (Some(first), Some(last)) = (front.first(), front.len().checked_sub(1)) else {
            return Vec::new();
        };
        let mut places = vec![0, last / 2, last];
        places.dedup();
        let one = |place: &usize| {
            let Overall { name, time_ms, angle_deg } = &front[*place];
            let [times, errors] =
                [time_ms / first.time_ms, first.angle_deg.value / angle_deg.value].map(digits);
            let beside = match place {
                0 => String::new(),
                _ => format!(", {times} times the time for an error {errors} times smaller"),
            };
            format!(
                "Within {} a frame use {name}: {} off{beside}",
                duration(*time_ms),
                degrees(angle_deg)
            )
        };
        let list: Vec<String> = places.iter().map(one).collect();
        let over = match self.0.len() {
            1 => String::new(),
            count => format!(", geometric mean over {count} scenes; time of the slowest"),
        };
        vec![format!("{}. Off: median exit angle{over}.", list.join(". "))]
    }

    /// Who leads, and in how many scenes.
    fn best(&self) -> Option<String> {
        let mut wins: BTreeMap<&str, usize> = BTreeMap::new();
        let mut shared = 0;
        for (_, methods) in &self.0 {
            let values: Vec<_> = methods.iter().map(|(_, found)| Some(found.angle_deg)).collect();
            let marks = ranking::best(METRIC, &values, None);
            let best: Vec<&str> = methods
                .iter()
                .zip(&marks)
                .filter(|(_, best)| **best)
                .map(|(m, _)| m.0.as_str())
                .collect();
            shared += usize::from(best.len() > 1);
            best.into_iter().for_each(|name| *wins.entry(name).or_default() += 1);
        }
        let (name, count) = wins.into_iter().max_by_key(|(_, count)| *count)?;
        let mut text = format!(
            "{name} sends light in the best direction in {count} of {} scenes",
            self.0.len()
        );
        if shared > 0 {
            text.push_str(&format!("; in {shared} others cannot be told from the best"));
        }
        Some(format!("{text}."))
    }

    /// Scenes in which every method is visibly wrong.
    fn where_none_will_do(&self) -> Option<String> {
        let fails = |(_, methods): &&(String, Vec<(String, Found)>)| {
            methods.iter().all(|(_, found)| found.angle_deg.low > WILL_DO_DEG)
        };
        let names: Vec<&str> = self.0.iter().filter(fails).map(|(name, _)| name.as_str()).collect();
        (!names.is_empty()).then(|| {
            format!("No method is within {WILL_DO_DEG}° in the median in: {}.", names.join(", "))
        })
    }
}

fn overall(name: &str, found: &[Found]) -> Option<Overall> {
    let times: Option<Vec<f64>> = found.iter().map(|one| one.time_ms).collect();
    let log = |value: f64| value.max(SMALLEST_DEG).ln();
    let count = found.len() as f64;
    let mean = found.iter().map(|one| log(one.angle_deg.value)).sum::<f64>() / count;
    let half = |one: &Found| 0.5 * (log(one.angle_deg.high) - log(one.angle_deg.low));
    let half = found.iter().map(|one| half(one).powi(2)).sum::<f64>().sqrt() / count;
    let [value, low, high] = [mean, mean - half, mean + half].map(f64::exp);
    Some(Overall {
        name: name.to_owned(),
        time_ms: times?.into_iter().fold(0.0, f64::max),
        angle_deg: Ranked { value, low, high },
    })
}

/// `12.3° ± 0.4°`.
fn degrees(angle: &Ranked) -> String {
    match 0.5 * (angle.high - angle.low) {
        half if half > 0.0 => format!("{}° ± {}°", digits(angle.value), digits(half)),
        _ => format!("{}°", digits(angle.value)),
    }
}

/// Against what, on what.
fn truth(study: &Study) -> String {
    let clock = if study.software {
        "is a CPU in the role of a GPU, so times compare methods with each other, not with hardware"
    } else {
        "is a GPU"
    };
    format!(
        "Truth is snell's own ray tracer in 64-bit arithmetic; the adapter, {}, {clock}.",
        if study.adapter.is_empty() { "not named" } else { &study.adapter }
    )
}
