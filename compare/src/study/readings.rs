//! What the curves of error against time say in words: at equal error, at equal
//! time, within a budget.

use crate::metric::Metric;
use crate::report::number::{digits, duration};
use crate::results::curves::{Curve, curves};
use crate::results::{REFERENCE, Reading, ResultRow, SceneEntry, Study};

/// Every reading of a study, scene by scene. Errors are relative MSE without the
/// worst thousandth of the pixels, which a few pixels of the sun cannot turn.
pub(super) fn readings(study: &Study, rows: &[ResultRow]) -> Vec<Reading> {
    let metric = Metric::RelMseTrimmed.describe().name;
    let of_entry = |entry: &SceneEntry| {
        let curves = curves(study, entry, rows, metric);
        let (exact, methods): (Vec<Curve>, Vec<Curve>) =
            curves.into_iter().partition(|curve| curve.method == REFERENCE);
        let mut list = Vec::new();
        if let Some(exact) = exact.first() {
            list.extend(methods.iter().flat_map(|method| beside(entry, method, exact)));
        }
        if let Some(budget_ms) = study.budget_ms {
            list.push(within(entry, budget_ms, &methods, exact.first()));
        }
        list
    };
    study.scenes.iter().flat_map(of_entry).collect()
}

/// A method beside the exact renderer, at its most exact setting.
fn beside(entry: &SceneEntry, method: &Curve, exact: &Curve) -> Vec<Reading> {
    let Some(best) = method.front().last().copied() else { return Vec::new() };
    let (name, error, time) = (&method.method, digits(best.error), duration(best.time_ms));
    let setting =
        if best.setting.is_empty() { String::new() } else { format!(" ({})", best.setting) };
    let reading = |kind: &str, value, text| Reading {
        scene: entry.name.clone(),
        method: name.clone(),
        kind: kind.to_owned(),
        text,
        value,
    };
    let first = exact.points.first().map_or(0.0, |point| point.time_ms);
    let at_error = exact.time_at_error(best.error);
    let how = match at_error {
        None => "does not come so far in the time that was spent on it".to_owned(),
        Some(ms) if ms <= first => format!("needs less than {}", duration(first)),
        Some(ms) => format!("needs {}", duration(ms)),
    };
    let equal_error = reading(
        "equal-error",
        at_error,
        format!("at {name}'s error{setting}, {error} in {time}, the exact renderer {how}"),
    );
    let at_time = exact.error_at_time(best.time_ms);
    let how = match at_time {
        None => "has no image yet".to_owned(),
        Some(own) if own > 0.0 && own < best.error => {
            format!("is at {}, {} times more exact", digits(own), digits(best.error / own))
        }
        Some(own) if own > best.error && best.error > 0.0 => {
            format!("is at {}, {} times less exact", digits(own), digits(own / best.error))
        }
        Some(own) => format!("is at {}", digits(own)),
    };
    let equal_time = reading(
        "equal-time",
        at_time,
        format!("in {name}'s time{setting}, {time} for {error}, the exact renderer {how}"),
    );
    vec![equal_error, equal_time]
}

/// The setting with the least error whose frame takes no longer than a budget.
fn within(entry: &SceneEntry, budget_ms: f64, methods: &[Curve], exact: Option<&Curve>) -> Reading {
    let all = methods.iter().flat_map(|curve| curve.points.iter().map(move |point| (curve, point)));
    let fit = all.filter(|(_, point)| point.time_ms <= budget_ms);
    let best = fit
        .min_by(|a, b| a.1.error.total_cmp(&b.1.error).then(a.1.time_ms.total_cmp(&b.1.time_ms)));
    let budget = duration(budget_ms);
    let (method, value, mut text) = match best {
        None => (String::new(), None, format!("within {budget}: no method")),
        Some((curve, point)) => {
            let setting = if point.setting.is_empty() {
                String::new()
            } else {
                format!(" ({})", point.setting)
            };
            let (error, time) = (digits(point.error), duration(point.time_ms));
            let text = format!("within {budget}: {}{setting}, {error} in {time}", curve.method);
            (curve.method.clone(), Some(point.error), text)
        }
    };
    match exact.and_then(|curve| curve.error_at_time(budget_ms)) {
        Some(error) => text.push_str(&format!("; the exact renderer: {}", digits(error))),
        None => text.push_str("; the exact renderer: no image yet"),
    }
    Reading { scene: entry.name.clone(), method, kind: "budget".to_owned(), text, value }
}
