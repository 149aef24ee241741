//! By how much head is worse than base, measured against the same truth.
//!
//! Both are compared with one truth m, so the noise of m enters once and not
//! squared: (h - m)² - (b - m)² = (h - b)(h + b - 2 m) is linear in it. Nothing
//! needs correcting, and the interval is many times narrower than that of two
//! errors measured apart. A *ratio* of two errors measured apart would be pulled
//! towards 1 by the noise in both.
//!
//! Images are interleaved RGB of one size. A method that draws random numbers
//! gives several images on either side, one per seed; the scatter between them
//! counts. One image alone is taken as free of scatter.

use crate::metric::flip::{Exposures, hdr_flip_map, ldr_flip_map};
use crate::support::statistics::{Estimate, mean_of_samples};
use crate::support::sum::{mean, sum};
use scenes::noise::SplitMix64;

/// ε of the weights 1 / (r0² + ε), radiance².
pub const WEIGHT_EPSILON: f64 = 1e-2;
/// Truths that are drawn from the stated noise to see how a metric scatters
/// that is not linear in the truth.
const DRAWS: u32 = 16;

/// The exact image, as exactly as it is known.
#[derive(Clone, Copy, Debug)]
pub struct Truth<'a> {
    /// Radiance.
    pub mean: &'a [f64],
    /// Standard error of each value of `mean`; `None` where it has no noise.
    pub standard_error: Option<&'a [f64]>,
    /// r0 of the frozen weights: an image that shares no noise with `mean`. Where
    /// `mean` has no noise it may be the same image.
    pub frozen: &'a [f64],
}

/// Images of one method, one per seed.
pub type Images<'a> = &'a [&'a [f64]];

impl Truth<'_> {
    fn weight(&self, i: usize) -> f64 {
        1.0 / (self.frozen[i] * self.frozen[i] + WEIGHT_EPSILON)
    }

    /// Standard error of the mean of c times the truth, for one factor per value.
    /// The pixels are independent; the channels of one pixel see the same paths
    /// and are taken as fully dependent, which can only raise it.
    fn noise_of(&self, factor: impl Fn(usize) -> f64) -> f64 {
        let Some(error) = self.standard_error else { return 0.0 };
        let pixel = |p: usize| (3 * p..3 * p + 3).map(|i| factor(i).abs() * error[i]).sum::<f64>();
        let squares = sum((0..self.mean.len() / 3).map(|p| pixel(p).powi(2)));
        squares.sqrt() / self.mean.len() as f64
    }
}

/// Mean of w (h - m)² less mean of w (b - m)², w = 1 / (r0² + 0.01): positive
/// where head is worse. `None` without an image on both sides.
#[must_use]
pub fn of_relmse(truth: &Truth, head: Images, base: Images) -> Option<Estimate> {
    let error = |image: &[f64]| relmse(truth, image);
    let (h, b) = (mean_image(head), mean_image(base));
    let from_truth = truth.noise_of(|i| 2.0 * truth.weight(i) * (h[i] - b[i]));
    between(head, base, error).map(|difference| difference.plus(Estimate::known(0.0, from_truth)))
}

/// Mean of w (t - m)²: noise of the truth included.
#[must_use]
pub fn relmse(truth: &Truth, image: &[f64]) -> f64 {
    let term = |i: usize| truth.weight(i) * (image[i] - truth.mean[i]).powi(2);
    mean((0..image.len()).map(term))
}

/// Error of an image with the noise of the truth subtracted; it may be negative.
#[must_use]
pub fn corrected_relmse(truth: &Truth, image: &[f64]) -> f64 {
    let noise = truth
        .standard_error
        .map_or(0.0, |error| mean((0..image.len()).map(|i| truth.weight(i) * error[i] * error[i])));
    relmse(truth, image) - noise
}

/// |mean of h - m| less |mean of b - m|: positive where head is further from the
/// right brightness.
#[must_use]
pub fn of_bias(truth: &Truth, head: Images, base: Images) -> Option<Estimate> {
    let (h, b) = (mean(mean_image(head).into_iter()), mean(mean_image(base).into_iter()));
    let m = mean(truth.mean.iter().copied());
    // While both are on one side of the truth, its noise cancels.
    let factor = f64::from(i8::from(h >= m) - i8::from(b >= m));
    let from_truth = truth.noise_of(|_| 2.0 * factor);
    let error = |image: &[f64]| (mean(image.iter().copied()) - m).abs();
    between(head, base, error).map(|difference| difference.plus(Estimate::known(0.0, from_truth)))
}

/// How FLIP looks at both sides of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eye {
    /// HDR-FLIP of linear radiance.
    Linear(Exposures),
    /// LDR-FLIP of display code values, 0 to 1.
    Display,
}

/// Mean FLIP of head less that of base. FLIP is not linear in the truth: its
/// scatter is that over truths drawn from the stated noise, seeded.
///
/// # Errors
/// If FLIP cannot be measured, with the reason.
pub fn of_flip(
    truth: &Truth,
    head: Images,
    base: Images,
    size_px: [usize; 2],
    eye: Eye,
) -> Result<Option<Estimate>, String> {
    let of = |m: &[f64], images: Images| -> Result<Vec<f64>, String> {
        images.iter().map(|image| mean_flip(m, image, size_px, eye)).collect()
    };
    let (h, b) = (of(truth.mean, head)?, of(truth.mean, base)?);
    let (Some(h), Some(b)) = (mean_of_samples(&h), mean_of_samples(&b)) else { return Ok(None) };
    let difference = h.plus(b.times(-1.0));
    let Some(error) = truth.standard_error.filter(|_| head != base) else {
        return Ok(Some(difference));
    };
    let (h, b) = (mean_image(head), mean_image(base));
    let mut random = SplitMix64(1);
    let mut drawn = Vec::new();
    for _ in 0..DRAWS {
        let m: Vec<f64> = truth
            .mean
            .chunks_exact(3)
            .zip(error.chunks_exact(3))
            .flat_map(|(m, error)| {
                let z = random.normal();
                // Light is not negative, whatever its noise.
                [0, 1, 2].map(|c| (m[c] + z * error[c]).max(m[c].min(0.0)))
            })
            .collect();
        drawn.push(mean_flip(&m, &h, size_px, eye)? - mean_flip(&m, &b, size_px, eye)?);
    }
    let scatter = mean_of_samples(&drawn).map_or(0.0, |drawn| {
        // The scatter of one draw, not of their mean.
        drawn.standard_error * f64::from(DRAWS).sqrt()
    });
    let degrees_of_freedom = f64::from(DRAWS - 1);
    Ok(Some(difference.plus(Estimate { value: 0.0, standard_error: scatter, degrees_of_freedom })))
}

/// Mean FLIP of an image against a truth.
///
/// # Errors
/// If it cannot be measured, with the reason.
pub fn mean_flip(m: &[f64], image: &[f64], size_px: [usize; 2], eye: Eye) -> Result<f64, String> {
    let map = match eye {
        Eye::Linear(exposures) => hdr_flip_map(m, image, size_px, exposures)?,
        Eye::Display => ldr_flip_map(m, image, size_px, crate::metric::flip::PIXELS_PER_DEGREE)?,
    };
    Ok(mean(map.into_iter()))
}

/// The difference that [`of_relmse`] averages, per pixel, mean over channels.
#[must_use]
pub fn relmse_map(truth: &Truth, head: Images, base: Images) -> Vec<f64> {
    let (h, b) = (mean_image(head), mean_image(base));
    let term = |i: usize| truth.weight(i) * (h[i] - b[i]) * (h[i] + b[i] - 2.0 * truth.mean[i]);
    (0..truth.mean.len() / 3).map(|p| (3 * p..3 * p + 3).map(term).sum::<f64>() / 3.0).collect()
}

/// Mean of several images; empty for none.
#[must_use]
pub fn mean_image(images: Images) -> Vec<f64> {
    let count = images.len() as f64;
    let length = images.first().map_or(0, |image| image.len());
    (0..length).map(|i| images.iter().map(|image| image[i]).sum::<f64>() / count).collect()
}

/// Difference of the means of an error over the seeds of both sides, with the
/// scatter between seeds.
fn between(head: Images, base: Images, error: impl Fn(&[f64]) -> f64) -> Option<Estimate> {
    let of = |images: Images| -> Vec<f64> { images.iter().map(|image| error(image)).collect() };
    let (head, base) = (mean_of_samples(&of(head))?, mean_of_samples(&of(base))?);
    Some(head.plus(base.times(-1.0)))
}
