//! Perceptually uniform encoding of luminance, so that PSNR means something
//! on HDR images.
//!
//! Source: Mantiuk & Azimi, *PU21: A novel perceptually uniform encoding for
//! adapting existing quality metrics for HDR*, Picture Coding Symposium 2021,
//! variant "banding + glare".

use super::display::psnr_db;

/// Fitted constants of the variant "banding + glare".
const P: [f64; 7] = [
    0.353487901,
    0.3734658629,
    8.277049286e-05,
    0.9062562627,
    0.09150303166,
    0.9099517204,
    596.3148142,
];

/// Encodes an absolute luminance in cd/m², clipped to 0.005..10,000, to a
/// value of 0 to 595.4; 100 cd/m² becomes 256.4.
#[must_use]
pub fn encode(luminance_cd_m2: f64) -> f64 {
    let y = luminance_cd_m2.clamp(0.005, 1e4).powf(P[3]);
    (P[6] * (((P[0] + P[1] * y) / (1.0 + P[2] * y)).powf(P[4]) - P[5])).max(0.0)
}

/// PSNR in dB of the encoded channels, peak 256. `None` for equal images.
///
/// `nits_per_unit`: luminance of radiance 1, cd/m²; part of the metric.
///
/// Range: any number; higher is better.
#[must_use]
pub fn pu21_psnr_db(reference: &[f64], candidate: &[f64], nits_per_unit: f64) -> Option<f64> {
    let encoded = |image: &[f64]| -> Vec<f64> {
        image.iter().map(|value| encode(value * nits_per_unit)).collect()
    };
    psnr_db(&encoded(reference), &encoded(candidate), 256.0)
}
