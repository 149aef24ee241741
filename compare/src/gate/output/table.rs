//! The table: one row per check.

use crate::gate::run::Checked;
use crate::gate::verdict::{Check, Outcome};

/// Rows of text, the heading first. Checks that pass with nothing to say about
/// work are counted in [`summary`] and not listed.
#[must_use]
pub fn rows(checked: &Checked) -> Vec<Vec<String>> {
    let heading =
        ["cell", "metric", "base", "head", "difference", "95 % interval", "margin", "p", "outcome"];
    let listed = checked.checks.iter().filter(|check| {
        let quiet = check.outcome == Outcome::Pass && check.reason.is_empty();
        !(quiet && check.metric.starts_with("work_"))
    });
    std::iter::once(heading.map(str::to_owned).to_vec()).chain(listed.map(row)).collect()
}

fn row(check: &Check) -> Vec<String> {
    let interval = match (check.ci_lo, check.ci_hi) {
        (Some(low), Some(high)) => format!("[{}, {}]", short(low), short(high)),
        _ => String::new(),
    };
    let number = |value: Option<f64>| value.map_or_else(String::new, short);
    let outcome = match check.reason.as_str() {
        "" => check.outcome.word().to_owned(),
        reason => format!("{}: {}", check.outcome.word(), reason.replace('\n', "; ")),
    };
    vec![
        check.cell.clone(),
        check.metric.clone(),
        number(check.base),
        number(check.head),
        number(check.difference),
        interval,
        number(check.margin),
        number(check.p),
        outcome,
    ]
}

/// Four digits, as short as they can be written.
#[must_use]
pub fn short(value: f64) -> String {
    let plain = value == 0.0 || (1e-4..1e7).contains(&value.abs());
    if !plain {
        return format!("{value:.2e}");
    }
    if value.fract() == 0.0 {
        return format!("{value}");
    }
    let before = value.abs().log10().floor().max(0.0) as usize;
    format!("{value:.*}", 5usize.saturating_sub(before))
}

/// One line: how many of what.
#[must_use]
pub fn summary(checked: &Checked) -> String {
    let count = |outcome| checked.checks.iter().filter(|c| c.outcome == outcome).count();
    let adapter = checked.adapter.map_or_else(String::new, |class| format!(" ({class})"));
    format!(
        "{}: {} checks of {} cells on {}{adapter}: {} pass, {} warn, {} inconclusive, {} fail",
        checked.outcome().word().to_uppercase(),
        checked.checks.len(),
        checked.judged.len(),
        checked.device,
        count(Outcome::Pass),
        count(Outcome::Warn),
        count(Outcome::Inconclusive),
        count(Outcome::Fail),
    )
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (41_092_720.0, "4.11e7"),
            (3.0, "3"),
            (0.123_456, "0.12346"),
            (-12.345_67, "-12.3457"),
            (1.5e-9, "1.50e-9"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
