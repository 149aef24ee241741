//! Errors relative to the reference, with the constant in the name.
//!
//! At least five formulas are called "relMSE" in published tools and differ
//! by orders of magnitude on dark images, so none of ours is named without
//! its ε. d = candidate - reference = t - r.

use crate::support::sum::{mean, sum};

/// Mean of d² / (r² + ε), the form of Rousselle, Knaus & Zwicker, *Adaptive
/// sampling and reconstruction using greedy error minimization*, ACM TOG
/// 30(6), 2011 (ε differs between papers).
///
/// Unit: none. Range: 0 (best) upwards.
#[must_use]
pub fn relmse(reference: &[f64], candidate: &[f64], epsilon: f64) -> f64 {
    relmse_frozen(reference, candidate, reference, epsilon)
}

/// Mean of d² / (r0² + ε) with r0 from a third image.
///
/// A noisy reference in its own denominator biases [`relmse`] in a way that
/// no correction removes; an independent, stored r0 does not.
#[must_use]
pub fn relmse_frozen(reference: &[f64], candidate: &[f64], frozen: &[f64], epsilon: f64) -> f64 {
    let terms = reference.iter().zip(candidate).zip(frozen);
    mean(terms.map(|((r, t), r0)| (t - r) * (t - r) / (r0 * r0 + epsilon)))
}

/// d² / (r² + ε) of each pixel, mean over its three channels.
#[must_use]
pub fn relmse_map(reference: &[f64], candidate: &[f64], epsilon: f64) -> Vec<f64> {
    let pixels = reference.chunks_exact(3).zip(candidate.chunks_exact(3));
    pixels.map(|(r, t)| relmse(r, t, epsilon)).collect()
}

/// [`relmse`] without its worst pixels: per-pixel means, ascending, the
/// ⌊share · N⌋ largest dropped, mean of the rest.
///
/// It hides fireflies, and real caustics and glints with them: read it beside
/// the untrimmed value, never instead.
#[must_use]
pub fn relmse_trimmed(reference: &[f64], candidate: &[f64], epsilon: f64, share: f64) -> f64 {
    let mut pixels = relmse_map(reference, candidate, epsilon);
    pixels.sort_unstable_by(f64::total_cmp);
    let kept = pixels.len() - (share * pixels.len() as f64).floor() as usize;
    sum(pixels[..kept].iter().copied()) / kept as f64
}

/// Share of [`relmse`] that its `count` worst pixels carry; 0 where it is 0.
///
/// Near 1 the metric tells of these pixels and of nothing else.
#[must_use]
pub fn worst_share(reference: &[f64], candidate: &[f64], epsilon: f64, count: usize) -> f64 {
    let mut pixels = relmse_map(reference, candidate, epsilon);
    pixels.sort_unstable_by(|a, b| b.total_cmp(a));
    let all = sum(pixels.iter().copied());
    let worst = sum(pixels.iter().take(count).copied());
    if all > 0.0 { worst / all } else { 0.0 }
}

/// Mean of |d| / (|r| + ε).
///
/// Unit: none (1 = 100 %). Range: 0 (best) upwards.
#[must_use]
pub fn mape(reference: &[f64], candidate: &[f64], epsilon: f64) -> f64 {
    let terms = reference.iter().zip(candidate);
    mean(terms.map(|(r, t)| (t - r).abs() / (r.abs() + epsilon)))
}

/// Mean of 2 |d| / (|r| + |t| + 2 ε): bounded, and alike in both images.
///
/// Unit: none. Range: 0 (best) to 2.
#[must_use]
pub fn smape(reference: &[f64], candidate: &[f64], epsilon: f64) -> f64 {
    let terms = reference.iter().zip(candidate);
    mean(terms.map(|(r, t)| 2.0 * (t - r).abs() / (r.abs() + t.abs() + 2.0 * epsilon)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_pixel_carries_its_share() {
        let reference = [1.0; 12];
        let mut candidate = [1.1; 12];
        candidate[..3].fill(1.3);
        // 0.3² beside three times 0.1²: nine of twelve parts.
        assert!((worst_share(&reference, &candidate, 0.0, 1) - 0.75).abs() < 1e-12);
        assert_eq!(worst_share(&reference, &candidate, 0.0, 0), 0.0);
        assert!((worst_share(&reference, &candidate, 0.0, 100) - 1.0).abs() < 1e-12);
        assert_eq!(worst_share(&reference, &reference, 0.01, 1), 0.0);
    }
}
