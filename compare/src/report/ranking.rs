//! Which methods are best: all that cannot be told from the best, and none that is within
//! the exact renderer's own error.

use super::numbers::{is_better, usable};
use crate::metric::{Better, Metric};
use crate::results::ResultRow;

/// A value with its interval, which is the value where none is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ranked {
    pub(super) value: f64,
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Ranked {
    /// Of a row that may be used.
    pub(super) fn of(row: &ResultRow) -> Option<Self> {
        let value = usable(row)?;
        let (low, high) = row.ci_lo.zip(row.ci_hi).unwrap_or((value, value));
        Some(Self { value, low, high })
    }

    /// True if two values differ by less than their intervals explain: each side of the
    /// gap reaches out on its own, and independent scatter adds in squares.
    fn is_as(self, other: Self) -> bool {
        let (small, large) = if self.value <= other.value { (self, other) } else { (other, self) };
        large.value - small.value <= (small.high - small.value).hypot(large.value - large.low)
    }
}

/// The best of several values and all that cannot be told from it. Where even the best is
/// below `floor`, what the exact renderer itself is off by with as many samples, the
/// metric ranks noise, and none is.
pub(super) fn best(metric: Metric, values: &[Option<Ranked>], floor: Option<f64>) -> Vec<bool> {
    if metric.describe().better == Better::Neither {
        return vec![false; values.len()];
    }
    let best = values
        .iter()
        .flatten()
        .copied()
        .reduce(|a, b| if is_better(metric, b.value, a.value) { b } else { a });
    let lost = |best: Ranked| {
        metric.describe().better == Better::Lower && floor.is_some_and(|floor| best.value < floor)
    };
    let Some(best) = best.filter(|best| !lost(*best)) else { return vec![false; values.len()] };
    values.iter().map(|value| value.is_some_and(|value| value.is_as(best))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn within(value: f64, half: f64) -> Option<Ranked> {
        Some(Ranked { value, low: value - half, high: value + half })
    }

    /// 64.46 and 64.54 degrees, each known to 0.2, are one result; to 0.01 they are two.
    #[test]
    fn what_cannot_be_told_from_the_best_is_best_too() {
        let metric = Metric::ExitAngleMedian;
        let of = |half| best(metric, &[within(64.46, half), within(64.54, half), None], None);
        assert_eq!(of(0.2), [true, true, false]);
        assert_eq!(of(0.01), [true, false, false]);
        let share = [within(0.5, 0.01), within(0.9, 0.01)];
        assert_eq!(best(Metric::ExitWithin1Deg, &share, None), [false, true]);
    }

    #[test]
    fn nothing_is_best_below_the_exact_renderers_own_error() {
        let values = [within(0.02, 0.001), within(0.05, 0.001)];
        assert_eq!(best(Metric::RelMse, &values, Some(0.01)), [true, false]);
        assert_eq!(best(Metric::RelMse, &values, Some(0.03)), [false, false]);
    }
}
