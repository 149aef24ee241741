//! Logarithmic axes.

use super::marks::power;

/// One logarithmic axis: its ends lie at 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    /// Logarithms of the ends, base 10.
    low: f64,
    high: f64,
    /// Where the ends are drawn.
    from: f64,
    to: f64,
}

impl Axis {
    /// An axis that holds the positive values with some room; `None` if there
    /// is none.
    pub(super) fn new(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<Self> {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| *value > 0.0 && value.is_finite()) {
            (low, high) = (low.min(value.log10()), high.max(value.log10()));
        }
        if low > high {
            return None;
        }
        let room = 0.05 * (high - low).max(1.0);
        let ends = round(low - room, high + room);
        Some(Self { low: ends[0], high: ends[1], from, to })
    }

    pub(super) fn place(&self, value: f64) -> f64 {
        let share = (value.log10() - self.low) / (self.high - self.low);
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// Values with a line and a label: decades, thinned to at most eight; on a
    /// short axis also 2 and 5 times them.
    pub(super) fn labelled(&self) -> Vec<(f64, String)> {
        let factors: &[f64] = if self.high - self.low < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let step = ((self.high - self.low).ceil() as usize).div_ceil(8).max(1);
        let decades = (self.low.floor() as i32..=self.high.ceil() as i32).step_by(step);
        let ticks = decades.flat_map(|decade| factors.iter().map(move |factor| (*factor, decade)));
        ticks
            .map(|(factor, decade)| (factor * 10f64.powi(decade), label(factor, decade)))
            .filter(|(value, _)| self.holds(*value))
            .collect()
    }

    /// Values with a short mark.
    pub(super) fn marked(&self) -> impl Iterator<Item = f64> {
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let values = decades.flat_map(|d| (1..10).map(move |k| f64::from(k) * 10f64.powi(d)));
        values.filter(|value| self.holds(*value))
    }

    fn holds(&self, value: f64) -> bool {
        (self.low - 1e-9..=self.high + 1e-9).contains(&value.log10())
    }
}

/// Moves the ends outwards to 1, 2 or 5 times a power of ten.
fn round(low: f64, high: f64) -> [f64; 2] {
    let steps = [0.0, 2f64.log10(), 5f64.log10(), 1.0];
    let down = |value: f64| {
        let part = value - value.floor();
        let below = steps.iter().rev().find(|step| **step <= part + 1e-9).unwrap_or(&0.0);
        value.floor() + below
    };
    let up = |value: f64| {
        let part = value - value.floor();
        value.floor() + steps.iter().find(|step| **step >= part - 1e-9).unwrap_or(&1.0)
    };
    [down(low), up(high)]
}

/// A tick's number: plain from 0.001 to 50,000.
fn label(factor: f64, decade: i32) -> String {
    match (decade, factor == 1.0) {
        (-3..=4, _) => {
            let decimals = (-decade).max(0) as usize;
            format!("{:.decimals$}", factor * 10f64.powi(decade))
        }
        (_, true) => power(decade),
        (_, false) => format!("{factor}·{}", power(decade)),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;

    #[test]
    fn a_decade_is_as_long_anywhere_on_the_axis() {
        let axis = Axis::new([1.6, 700.0].into_iter(), 0.0, 300.0).unwrap();
        let places = [1.0, 10.0, 100.0, 1000.0].map(|v| axis.place(v).round());
        assert_eq!(places, [0.0, 100.0, 200.0, 300.0]);
        assert!(Axis::new([0.0, -1.0].into_iter(), 0.0, 1.0).is_none());
    }

    #[test]
    fn a_short_axis_is_labelled_within_its_decades() {
        let labels = |values: [f64; 2]| -> Vec<String> {
            let axis = Axis::new(values.into_iter(), 0.0, 1.0).unwrap();
            axis.labelled().into_iter().map(|(_, label)| label).collect()
        };
        assert_eq!(labels([250.0, 900.0]), ["200", "500", "1000", "2000"]);
        assert_eq!(labels([0.003, 0.02]), ["0.002", "0.005", "0.01", "0.02", "0.05"]);
        assert_eq!(labels([1e-6, 1.0])[0], "10⁻⁶");
    }
}
