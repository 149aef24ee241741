//! Medians of few repetitions and how far to believe them.

use crate::support::sum::quantile;
use scenes::noise::SplitMix64;
use serde::Serialize;

/// Fewest repetitions whose smallest and largest value enclose the median with
/// a probability of 95 per cent, and one more.
pub const FEWEST: usize = 7;
const CONFIDENCE: f64 = 0.95;
const RESAMPLES: usize = 4_000;

/// A median with an interval that contains the true one 95 times in 100.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// Median of the repetitions.
    pub median: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// All three multiplied by a positive number.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        let Self { median, low, high } = self;
        Self { median: median * factor, low: low * factor, high: high * factor }
    }
}

/// The median with an interval between two of the values, which assumes nothing
/// about their distribution: the number of values below the true median is
/// binomial. With fewer than six values the interval, all of them, promises less.
///
/// Source: H. A. David, H. N. Nagaraja, "Order Statistics", 3rd ed., 2003, §7.1.
#[must_use]
pub fn median_interval(values: &[f64]) -> Interval {
    let sorted = sorted(values);
    let Some(last) = sorted.len().checked_sub(1) else {
        return Interval { median: f64::NAN, low: f64::NAN, high: f64::NAN };
    };
    let out = cut_off(sorted.len());
    Interval { median: middle(&sorted), low: sorted[out], high: sorted[last - out] }
}

/// The ratio of the medians of values that were measured in turns, with a
/// percentile bootstrap over the turns.
///
/// Source: B. Efron, R. J. Tibshirani, "An Introduction to the Bootstrap", 1993,
/// ch. 13.
#[must_use]
pub fn ratio_interval(over: &[f64], under: &[f64]) -> Interval {
    let count = over.len().min(under.len());
    let ratio = |over: &[f64], under: &[f64]| middle(&sorted(over)) / middle(&sorted(under));
    if count == 0 {
        return Interval { median: f64::NAN, low: f64::NAN, high: f64::NAN };
    }
    let mut random = SplitMix64(1);
    let mut drawn: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let turns: Vec<usize> =
                (0..count).map(|_| (random.uniform() * count as f64) as usize).collect();
            let pick = |from: &[f64]| turns.iter().map(|turn| from[*turn]).collect::<Vec<_>>();
            ratio(&pick(over), &pick(under))
        })
        .collect();
    drawn.sort_by(f64::total_cmp);
    let outside = (0.5 * (1.0 - CONFIDENCE) * RESAMPLES as f64) as usize;
    let (low, high) = (drawn[outside], drawn[RESAMPLES - 1 - outside]);
    Interval { median: ratio(&over[..count], &under[..count]), low, high }
}

/// How many of the smallest and of the largest of `count` values can be left
/// out.
fn cut_off(count: usize) -> usize {
    // The chance that at most k of the values lie below the true median.
    let mut chance = 0.5f64.powi(i32::try_from(count).unwrap_or(i32::MAX));
    let mut below = 0.0;
    let mut k = 0;
    loop {
        below += chance;
        if 2.0 * below > 1.0 - CONFIDENCE || k >= count {
            return k.saturating_sub(1);
        }
        chance *= (count - k) as f64 / (k + 1) as f64;
        k += 1;
    }
}

fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Median of ascending values; NaN for none.
fn middle(sorted: &[f64]) -> f64 {
    quantile(sorted, 0.5).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ranks from the table of David & Nagaraja: with 6 to 8 values the interval
    /// is all of them, from 9 values on it is not.
    #[test]
    fn the_ranks_are_those_of_the_table() {
        let known = [(6, 0), (7, 0), (8, 0), (9, 1), (12, 2), (15, 3), (20, 5), (25, 7)];
        for (count, out) in known {
            assert_eq!(cut_off(count), out, "{count}");
        }
        assert_eq!(cut_off(1), 0);
    }

    /// Of many samples, at least 95 in 100 intervals contain the true median;
    /// shifted by a deviation, few do.
    #[test]
    fn the_interval_contains_the_median_as_often_as_it_says() {
        let mut random = SplitMix64(9);
        let (mut inside, mut shifted) = (0, 0);
        for _ in 0..4_000 {
            let values: Vec<f64> = (0..9).map(|_| random.normal().exp()).collect();
            let Interval { low, high, .. } = median_interval(&values);
            inside += u32::from(low <= 1.0 && 1.0 <= high);
            shifted += u32::from(low <= 4.0 && 4.0 <= high);
        }
        assert!((3_800..3_920).contains(&inside) && shifted < 2_000, "{inside} {shifted}");
    }

    /// Two lognormal samples, one scaled by 0.8.
    #[test]
    fn a_ratio_of_medians_is_found() {
        let mut random = SplitMix64(2);
        let mut inside = 0;
        for _ in 0..200 {
            let under: Vec<f64> = (0..15).map(|_| (0.05 * random.normal()).exp()).collect();
            let over: Vec<f64> = (0..15).map(|_| 0.8 * (0.05 * random.normal()).exp()).collect();
            let ratio = ratio_interval(&over, &under);
            assert!((ratio.median - 0.8).abs() < 0.1, "{ratio:?}");
            inside += u32::from(ratio.low <= 0.8 && 0.8 <= ratio.high);
        }
        assert!(inside >= 180, "{inside}");
    }

    #[test]
    fn what_was_always_equal_has_no_width() {
        let same = [2.0; 7];
        assert_eq!(median_interval(&same), Interval { median: 2.0, low: 2.0, high: 2.0 });
        assert_eq!(ratio_interval(&same, &[4.0; 7]), Interval { median: 0.5, low: 0.5, high: 0.5 });
        assert!(median_interval(&[]).median.is_nan() && ratio_interval(&[], &[]).low.is_nan());
    }
}
