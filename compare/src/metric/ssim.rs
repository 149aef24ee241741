//! Structural similarity (SSIM) with the window of its paper.
//!
//! Source: Wang, Bovik, Sheikh & Simoncelli, *Image quality assessment: from
//! error visibility to structural similarity*, IEEE TIP 13(4), 2004, §III.B:
//! 11x11 Gaussian window, σ = 1.5, K1 = 0.01, K2 = 0.03, population moments.

/// Half width of the window, pixels.
const RADIUS: usize = 5;
/// Smallest side of an image that holds one window, pixels.
pub const SMALLEST_SIDE_PX: usize = 2 * RADIUS + 1;

/// SSIM of one channel at every pixel whose window lies inside the image:
/// (width - 10) x (height - 10) values, rows from the top. `None` when the
/// image is smaller than the window.
///
/// `range`: difference between white and black, 255 for 8-bit code values.
///
/// Range of the values: -1 to 1; 1 for equal windows.
#[must_use]
pub fn ssim_map(
    reference: &[f64],
    candidate: &[f64],
    size_px: [usize; 2],
    range: f64,
) -> Option<Vec<f64>> {
    if size_px[0] < SMALLEST_SIDE_PX || size_px[1] < SMALLEST_SIDE_PX {
        return None;
    }
    let c1 = (0.01 * range).powi(2);
    let c2 = (0.03 * range).powi(2);
    let product = |a: &[f64], b: &[f64]| -> Vec<f64> {
        let products: Vec<f64> = a.iter().zip(b).map(|(a, b)| a * b).collect();
        blur(&products, size_px)
    };
    let mean_r = blur(reference, size_px);
    let mean_t = blur(candidate, size_px);
    let square_r = product(reference, reference);
    let square_t = product(candidate, candidate);
    let cross = product(reference, candidate);
    let map = (0..mean_r.len()).map(|i| {
        let (r, t) = (mean_r[i], mean_t[i]);
        let (variance_r, variance_t) = (square_r[i] - r * r, square_t[i] - t * t);
        let covariance = cross[i] - r * t;
        (2.0 * r * t + c1) * (2.0 * covariance + c2)
            / ((r * r + t * t + c1) * (variance_r + variance_t + c2))
    });
    Some(map.collect())
}

/// Separable Gaussian of σ = 1.5 px over 11 taps, without the border.
fn blur(image: &[f64], [width, height]: [usize; 2]) -> Vec<f64> {
    let mut weights = [0.0; SMALLEST_SIDE_PX];
    for (i, weight) in weights.iter_mut().enumerate() {
        let x = i as f64 - RADIUS as f64;
        *weight = (-0.5 * (x / 1.5).powi(2)).exp();
    }
    let total: f64 = weights.iter().sum();
    let inner = [width - 2 * RADIUS, height - 2 * RADIUS];
    let mut rows = vec![0.0; inner[0] * height];
    for (line, row) in rows.chunks_exact_mut(inner[0]).zip(image.chunks_exact(width)) {
        for (x, value) in line.iter_mut().enumerate() {
            *value = weights.iter().zip(&row[x..]).map(|(w, v)| w * v / total).sum();
        }
    }
    let mut blurred = vec![0.0; inner[0] * inner[1]];
    for (y, line) in blurred.chunks_exact_mut(inner[0]).enumerate() {
        for (k, weight) in weights.iter().enumerate() {
            let row = &rows[(y + k) * inner[0]..][..inner[0]];
            for (value, v) in line.iter_mut().zip(row) {
                *value += weight * v / total;
            }
        }
    }
    blurred
}
