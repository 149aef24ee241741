//! A number with its standard error.

use super::student::{student_quantile, student_tail};
use crate::support::sum::{mean, sum};

/// A number, how far it scatters, and how well that is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard error, in the same unit; 0 for what does not scatter.
    pub standard_error: f64,
    /// Degrees of freedom of the standard error, for Student's t; infinite where
    /// the error is known and not estimated.
    pub degrees_of_freedom: f64,
}

impl Estimate {
    /// A number that does not scatter.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self::known(value, 0.0)
    }

    /// A number whose standard error is known.
    #[must_use]
    pub fn known(value: f64, standard_error: f64) -> Self {
        Self { value, standard_error, degrees_of_freedom: f64::INFINITY }
    }

    /// Two-sided interval, `confidence` in 0..1.
    #[must_use]
    pub fn interval(self, confidence: f64) -> (f64, f64) {
        if self.standard_error == 0.0 {
            return (self.value, self.value);
        }
        let t = student_quantile(0.5 * (1.0 - confidence), self.degrees_of_freedom);
        (self.value - t * self.standard_error, self.value + t * self.standard_error)
    }

    /// Probability of a value at least this large if the true one were
    /// `threshold`: small where the true one is surely above it.
    #[must_use]
    pub fn p_above(self, threshold: f64) -> f64 {
        if self.standard_error == 0.0 {
            return if self.value > threshold { 0.0 } else { 1.0 };
        }
        student_tail((self.value - threshold) / self.standard_error, self.degrees_of_freedom)
    }

    /// Sum with an independent estimate. Degrees of freedom by Welch and
    /// Satterthwaite (Welch, *Biometrika* 34, 1947).
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let [a, b] = [self, other].map(|e| e.standard_error * e.standard_error);
        let variance = a + b;
        let share = a * a / self.degrees_of_freedom + b * b / other.degrees_of_freedom;
        Self {
            value: self.value + other.value,
            standard_error: variance.sqrt(),
            degrees_of_freedom: if share > 0.0 {
                variance * variance / share
            } else {
                f64::INFINITY
            },
        }
    }

    /// The estimate times a number.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            standard_error: self.standard_error * factor.abs(),
            ..self
        }
    }
}

/// The mean of independent samples. One sample is taken as exact: there is
/// nothing to see a scatter in, and the caller has to know that there is none.
/// `None` for nothing.
#[must_use]
pub fn mean_of_samples(samples: &[f64]) -> Option<Estimate> {
    let n = samples.len() as f64;
    let value = mean(samples.iter().copied());
    match samples.len() {
        0 => None,
        1 => Some(Estimate::exact(value)),
        _ => {
            let squares = sum(samples.iter().map(|x| (x - value).powi(2)));
            let standard_error = (squares / (n - 1.0) / n).sqrt();
            Some(Estimate { value, standard_error, degrees_of_freedom: n - 1.0 })
        }
    }
}

/// The standard error of any statistic of K >= 2 independent batches, by leaving
/// one out at a time: `whole` is the statistic of all of them, `without[k]` that
/// of all but the k-th. `None` for fewer than two.
///
/// Source: Efron, *The jackknife, the bootstrap and other resampling plans*,
/// SIAM 1982, ch. 3.
#[must_use]
pub fn jackknife(whole: f64, without: &[f64]) -> Option<Estimate> {
    let k = without.len() as f64;
    if without.len() < 2 {
        return None;
    }
    let centre = mean(without.iter().copied());
    let squares = sum(without.iter().map(|x| (x - centre).powi(2)));
    let standard_error = (squares * (k - 1.0) / k).sqrt();
    Some(Estimate { value: whole, standard_error, degrees_of_freedom: k - 1.0 })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;
    use scenes::noise::SplitMix64;

    /// The jackknife of a mean is the standard error of the mean.
    #[test]
    fn leaving_one_out_of_a_mean_gives_its_own_standard_error() {
        let samples = [1.0, 4.0, 2.5, 7.0, -3.0];
        let total: f64 = samples.iter().sum();
        let without = samples.map(|x| (total - x) / 4.0);
        let direct = mean_of_samples(&samples).unwrap();
        let found = jackknife(direct.value, &without).unwrap();
        assert!((found.standard_error - direct.standard_error).abs() < 1e-14);
        assert_eq!(found.degrees_of_freedom, 4.0);
    }

    /// Two samples of unequal scatter: of 4,000 intervals 95 in 100 hold the true
    /// difference. Shifted by two standard errors, half of them do not.
    #[test]
    fn welch_intervals_hold_the_truth_as_often_as_they_say() {
        let mut random = SplitMix64(11);
        let (mut inside, mut shifted) = (0, 0);
        for _ in 0..4_000 {
            let a: Vec<f64> = (0..5).map(|_| 3.0 + random.normal()).collect();
            let b: Vec<f64> = (0..8).map(|_| 1.0 + 4.0 * random.normal()).collect();
            let difference =
                mean_of_samples(&a).unwrap().plus(mean_of_samples(&b).unwrap().times(-1.0));
            let (low, high) = difference.interval(0.95);
            inside += u32::from(low <= 2.0 && 2.0 <= high);
            let elsewhere = 2.0 + 2.0 * difference.standard_error;
            let (p, q) = (difference.p_above(elsewhere), difference.p_above(2.0));
            assert!(p > q, "a higher threshold is less surely exceeded");
            shifted += u32::from(low > 2.0 - 3.0 || high < 2.0 - 3.0);
        }
        assert!((3_740..3_860).contains(&inside), "{inside} of 4000");
        assert!(shifted > 1_500, "{shifted}");
    }

    #[test]
    fn what_does_not_scatter_is_above_or_not() {
        let exact = Estimate::exact(2.0);
        assert_eq!(exact.interval(0.95), (2.0, 2.0));
        assert_eq!((exact.p_above(1.9), exact.p_above(2.0)), (0.0, 1.0));
        assert_eq!(exact.plus(Estimate::exact(1.0)), Estimate::exact(3.0));
        assert!(mean_of_samples(&[]).is_none() && jackknife(1.0, &[1.0]).is_none());
        assert_eq!(mean_of_samples(&[5.0]), Some(Estimate::exact(5.0)));
    }
}
