//! Errors in the unit of the image: bias, MAE, MSE, RMSE, largest difference.
//!
//! Every function takes interleaved values of equal length, reference first,
//! and treats each value of each channel alike. d = candidate - reference.

use crate::support::sum::mean;

fn differences<'a>(
    reference: &'a [f64],
    candidate: &'a [f64],
) -> impl ExactSizeIterator<Item = f64> + 'a {
    reference.iter().zip(candidate).map(|(r, t)| t - r)
}

/// Mean of d. Positive: the candidate is too bright on the whole.
///
/// Unit: radiance. Range: any number; 0 is best.
#[must_use]
pub fn bias(reference: &[f64], candidate: &[f64]) -> f64 {
    mean(differences(reference, candidate))
}

/// Mean of |d|.
///
/// Unit: radiance. Range: 0 (best) upwards.
#[must_use]
pub fn mae(reference: &[f64], candidate: &[f64]) -> f64 {
    mean(differences(reference, candidate).map(f64::abs))
}

/// Mean of d².
///
/// Unit: radiance². Range: 0 (best) upwards. A single glint may dominate it.
#[must_use]
pub fn mse(reference: &[f64], candidate: &[f64]) -> f64 {
    mean(differences(reference, candidate).map(|d| d * d))
}

/// Square root of the [`mse`].
///
/// Unit: radiance. Range: 0 (best) upwards.
#[must_use]
pub fn rmse(reference: &[f64], candidate: &[f64]) -> f64 {
    mse(reference, candidate).sqrt()
}

/// Largest |d|.
///
/// Unit: radiance. Range: 0 (best) upwards.
#[must_use]
pub fn max_abs(reference: &[f64], candidate: &[f64]) -> f64 {
    differences(reference, candidate).fold(0.0, |worst, d| worst.max(d.abs()))
}
