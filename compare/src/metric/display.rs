//! Metrics of images as a display shows them: PSNR, and the fixed tone map
//! that makes 8-bit code values of radiance.

use super::error::mse;

/// Peak signal-to-noise ratio, 10 log10(peak² / MSE), in dB. `None` for equal
/// images, where it would be infinite.
///
/// Range: any number; higher is better. `peak`: the largest possible value.
#[must_use]
pub fn psnr_db(reference: &[f64], candidate: &[f64], peak: f64) -> Option<f64> {
    let mse = mse(reference, candidate);
    (mse > 0.0).then(|| 10.0 * (peak * peak / mse).log10())
}

/// The 8-bit code value (0 to 255) of a linear radiance: x / (1 + x) of
/// Reinhard et al. 2002 per channel, the transfer curve of sRGB
/// (IEC 61966-2-1), rounded half up. Negative radiance is black.
#[must_use]
pub fn code_value(radiance: f64) -> f64 {
    let shown = radiance.max(0.0);
    let linear = if shown.is_infinite() { 1.0 } else { shown / (1.0 + shown) };
    (255.0 * srgb_encode(linear) + 0.5).floor()
}

/// Transfer curve of sRGB, linear 0..1 to encoded 0..1 (IEC 61966-2-1).
#[must_use]
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Inverse of [`srgb_encode`].
#[must_use]
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_values_run_from_black_to_white() {
        assert_eq!(code_value(-1.0), 0.0);
        assert_eq!(code_value(0.0), 0.0);
        assert_eq!(code_value(1.0), 188.0, "half of the light is code value 188");
        assert_eq!(code_value(f64::MAX), 255.0);
    }

    #[test]
    fn decoding_inverts_encoding() {
        for step in 0..=1000 {
            let linear = f64::from(step) / 1000.0;
            assert!((srgb_decode(srgb_encode(linear)) - linear).abs() < 1e-7);
        }
    }
}
