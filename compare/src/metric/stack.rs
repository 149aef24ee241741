//! Errors against a reference that is itself noisy: K independent batches
//! instead of one image, the noise subtracted, an interval by the jackknife.
//!
//! The mean squared difference to a noisy mean is too large by the variance
//! of that mean. With d = candidate - mean of the batches and s² the sample
//! variance of one batch, the mean of d² - s²/K has no such bias; it can be
//! negative, and is then reported so, with its interval.

use crate::support::sum::{mean, sum};

/// A bias-corrected error with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorrectedError {
    /// Mean of w d², noise of the reference included.
    pub raw: f64,
    /// Mean of w (d² - s²/K): unbiased, may be negative.
    pub corrected: f64,
    /// Standard error of `corrected`, delete-one-batch jackknife.
    pub standard_error: f64,
    /// 95 % interval by Student's t with K - 1 degrees of freedom.
    pub interval: (f64, f64),
    /// Mean of w s²/K: what the noise adds to `raw`.
    pub noise: f64,
}

/// Bias-corrected mean of w d² against K >= 3 batches; `None` for fewer.
///
/// `weights`: w of each value, such as 1 / (r0² + ε) with r0 from an image
/// that shares no samples with the batches; 1 if `None`.
///
/// Source: the jackknife of Quenouille and Tukey (Efron, *The jackknife, the
/// bootstrap and other resampling plans*, SIAM 1982, ch. 3).
#[must_use]
pub fn corrected_mse(
    batches: &[&[f64]],
    candidate: &[f64],
    weights: Option<&[f64]>,
) -> Option<CorrectedError> {
    let k = batches.len();
    if k < 3 {
        return None;
    }
    let moments = Moments::of(batches);
    let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
    let whole: Vec<(f64, f64)> = (0..candidate.len())
        .map(|i| moments.squared_error_and_noise(i, candidate[i], None))
        .collect();
    let noise = mean(whole.iter().enumerate().map(|(i, (_, noise))| weight(i) * noise));
    let raw = mean(whole.iter().enumerate().map(|(i, (squared, _))| weight(i) * squared));
    let without: Vec<f64> = batches
        .iter()
        .map(|batch| {
            mean((0..candidate.len()).map(|i| {
                let (squared, noise) =
                    moments.squared_error_and_noise(i, candidate[i], Some(batch[i]));
                weight(i) * (squared - noise)
            }))
        })
        .collect();
    let centre = mean(without.iter().copied());
    let spread = without.iter().map(|value| (value - centre).powi(2)).sum::<f64>();
    let standard_error = (spread * (k - 1) as f64 / k as f64).sqrt();
    let corrected = raw - noise;
    let half = student_975(k - 1) * standard_error;
    let interval = (corrected - half, corrected + half);
    Some(CorrectedError { raw, corrected, standard_error, interval, noise })
}

/// Bias-corrected mean of d² against a mean image with the variance of that
/// mean, for references that are stored so and not as batches.
///
/// Interleaved RGB. The interval takes the noise of each value as Gaussian
/// with the given variance v, whose d² - v has variance 4 δ² v + 2 v² (δ the
/// true difference), pixels as independent and the channels of a pixel as
/// fully dependent, which can only widen it.
#[must_use]
pub fn corrected_mse_by_variance(
    reference: &[f64],
    candidate: &[f64],
    variance: &[f64],
) -> CorrectedError {
    let term = |i: usize| ((candidate[i] - reference[i]).powi(2), variance[i]);
    let raw = mean((0..reference.len()).map(|i| term(i).0));
    let noise = mean(variance.iter().copied());
    let deviation = |i: usize| {
        let (squared, v) = term(i);
        // d² has expectation δ² + v.
        (4.0 * (squared - v).max(0.0) * v + 2.0 * v * v).sqrt()
    };
    let pixels = reference.len() / 3;
    let spread =
        sum((0..pixels).map(|p| (0..3).map(|c| deviation(3 * p + c)).sum::<f64>().powi(2)));
    let standard_error = spread.sqrt() / reference.len() as f64;
    let corrected = raw - noise;
    let half = student_975(usize::MAX) * standard_error;
    CorrectedError {
        raw,
        corrected,
        standard_error,
        interval: (corrected - half, corrected + half),
        noise,
    }
}

/// Mean of (candidate - a)(candidate - b) for two independent references of
/// the same truth: unbiased for the squared error without any variance.
#[must_use]
pub fn dual_mse(a: &[f64], b: &[f64], candidate: &[f64]) -> f64 {
    mean(candidate.iter().zip(a).zip(b).map(|((t, a), b)| (t - a) * (t - b)))
}

/// By how much the squared error of `head` exceeds that of `base` against the
/// same noisy reference: value, standard error, 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Mean of w (d_head² - d_base²); positive: `head` is worse.
    pub value: f64,
    /// Standard error over the batches.
    pub standard_error: f64,
    /// 95 % interval by Student's t with K - 1 degrees of freedom.
    pub interval: (f64, f64),
}

/// Paired difference of two images' squared errors; `None` for fewer than two
/// batches.
///
/// d_head² - d_base² = (h - b)(h + b - 2 m) is linear in the reference m: its
/// noise enters once, not squared, so nothing needs correcting and the
/// interval is many times narrower than that of two errors measured apart.
#[must_use]
pub fn paired_difference(
    batches: &[&[f64]],
    head: &[f64],
    base: &[f64],
    weights: Option<&[f64]>,
) -> Option<Difference> {
    let k = batches.len();
    if k < 2 {
        return None;
    }
    let of_batch = |batch: &&[f64]| {
        mean((0..head.len()).map(|i| {
            let weight = weights.map_or(1.0, |w| w[i]);
            weight * (head[i] - base[i]) * (head[i] + base[i] - 2.0 * batch[i])
        }))
    };
    let values: Vec<f64> = batches.iter().map(of_batch).collect();
    let value = mean(values.iter().copied());
    let squares = sum(values.iter().map(|v| (v - value).powi(2)));
    let standard_error = (squares / (k - 1) as f64 / k as f64).sqrt();
    let half = student_975(k - 1) * standard_error;
    Some(Difference { value, standard_error, interval: (value - half, value + half) })
}

/// Mean of several images.
#[must_use]
pub fn mean_image(batches: &[&[f64]]) -> Vec<f64> {
    let pixels = batches.first().map_or(0, |batch| batch.len());
    (0..pixels).map(|i| mean(batches.iter().map(|batch| batch[i]))).collect()
}

/// First and second moments over the batches, about their mean.
struct Moments {
    k: f64,
    mean: Vec<f64>,
    /// Sum of squared deviations from the mean.
    squares: Vec<f64>,
}

impl Moments {
    fn of(batches: &[&[f64]]) -> Self {
        let mean = mean_image(batches);
        let squares = (0..mean.len())
            .map(|i| batches.iter().map(|batch| (batch[i] - mean[i]).powi(2)).sum())
            .collect();
        Self { k: batches.len() as f64, mean, squares }
    }

    /// d² and the variance of the mean at one value, with all batches or
    /// without the one whose value is given.
    fn squared_error_and_noise(&self, i: usize, t: f64, without: Option<f64>) -> (f64, f64) {
        let (mut k, mut mean, mut squares) = (self.k, self.mean[i], self.squares[i]);
        if let Some(x) = without {
            let from_mean = x - mean;
            squares = (squares - from_mean * from_mean * k / (k - 1.0)).max(0.0);
            mean -= from_mean / (k - 1.0);
            k -= 1.0;
        }
        ((t - mean).powi(2), squares / (k - 1.0) / k)
    }
}

/// 97.5 % quantile of Student's t distribution.
///
/// Source: Abramowitz & Stegun, *Handbook of Mathematical Functions*, table
/// 26.10 up to 10 degrees of freedom, expansion 26.7.5 above (error < 1e-3).
#[must_use]
pub fn student_975(degrees_of_freedom: usize) -> f64 {
    const TABLE: [f64; 10] =
        [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];
    if let Some(value) = degrees_of_freedom.checked_sub(1).and_then(|i| TABLE.get(i)) {
        return *value;
    }
    let (x, v) = (1.959_964f64, degrees_of_freedom as f64);
    let g1 = (x.powi(3) + x) / 4.0;
    let g2 = (5.0 * x.powi(5) + 16.0 * x.powi(3) + 3.0 * x) / 96.0;
    if degrees_of_freedom == 0 { f64::INFINITY } else { x + g1 / v + g2 / (v * v) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn student_quantiles_join_the_table_and_the_normal() {
        assert!((student_975(15) - 2.131).abs() < 1e-3);
        assert!((student_975(30) - 2.042).abs() < 1e-3);
        assert!((student_975(1_000_000) - 1.96).abs() < 1e-4);
        assert!(student_975(0).is_infinite());
    }

    #[test]
    fn without_noise_nothing_is_subtracted() {
        let batch = [1.0, 2.0];
        let found = corrected_mse(&[&batch, &batch, &batch], &[2.0, 2.0], None);
        let found = found.map(|e| (e.raw, e.corrected, e.standard_error));
        assert_eq!(found, Some((0.5, 0.5, 0.0)));
        assert!(corrected_mse(&[&batch, &batch], &[2.0, 2.0], None).is_none());
    }
}
