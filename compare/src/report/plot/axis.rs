//! Logarithmic axes.

/// One logarithmic axis: whole decades around the data, and where they lie.
pub(super) struct Axis {
    pub(super) low: i32,
    pub(super) high: i32,
    from: f64,
    to: f64,
}

impl Axis {
    pub(super) fn new(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<Self> {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| *value > 0.0 && value.is_finite()) {
            (low, high) = (low.min(value.log10()), high.max(value.log10()));
        }
        if low > high {
            return None;
        }
        let low_decade = (low - 0.05).floor() as i32;
        let high_decade = ((high + 0.05).ceil() as i32).max(low_decade + 1);
        Some(Self { low: low_decade, high: high_decade, from, to })
    }

    pub(super) fn place(&self, value: f64) -> f64 {
        let share = (value.log10() - f64::from(self.low)) / f64::from(self.high - self.low);
        self.from + share.clamp(0.0, 1.0) * (self.to - self.from)
    }

    /// Whole decades, thinned to at most eight.
    pub(super) fn decades(&self) -> impl Iterator<Item = i32> {
        let step = ((self.high - self.low) as usize).div_ceil(8);
        (self.low..=self.high).step_by(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decade_is_as_long_anywhere_on_the_axis() {
        let axis = Axis::new([1.5, 700.0].into_iter(), 0.0, 300.0);
        let places = axis.map(|a| [1.0, 10.0, 100.0, 1000.0].map(|v| a.place(v)));
        assert_eq!(places, Some([0.0, 100.0, 200.0, 300.0]));
        assert!(Axis::new([0.0, -1.0].into_iter(), 0.0, 1.0).is_none());
    }
}
