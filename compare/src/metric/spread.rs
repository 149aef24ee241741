//! How far a metric depends on where the pixel grid happens to lie.
//!
//! An image is a sample of its scene at the places of its pixels. Every fourth pixel in
//! both directions is another, coarser one; there are sixteen of them, shifted against
//! each other, and how the metric scatters between them tells how far its value would
//! move if the grid had been laid elsewhere. Noise of either image, independent from
//! pixel to pixel, scatters there too. A value that a few pixels make has a wide
//! interval, however many pixels the image has.
//!
//! Batch means with Student's t (Law & Kelton, *Simulation modeling and analysis*, ch. 9).
//! The sixteen interleave, so that their mean scatters less than that of independent ones:
//! the interval covers at least what it says.

use super::pair::{Answer, Pair, Sides};
use super::{Better, Metric};
use crate::support::statistics::{Estimate, jackknife, mean_of_samples};

/// Every so many pixels in x and y belong to one sub-lattice.
const STEP: usize = 4;
/// Sub-lattices.
pub(super) const COUNT: usize = STEP * STEP;
/// Confidence of the interval.
const CONFIDENCE: f64 = 0.95;
/// Fewest pixels of a sub-lattice that has a value of its own.
const FEWEST_PIXELS: usize = 16;

/// What the interval of a metric is of, as results say it.
pub(super) const SOURCE: &str = "16 sub-lattices of pixels";

/// The 95 % interval of a metric that has a value, or why there is none.
pub(super) fn interval(
    pair: &Pair,
    metric: Metric,
    sides: Sides,
    pixels: Option<&[usize]>,
    value: f64,
) -> Result<(f64, f64), &'static str> {
    let why = metric.describe().no_interval;
    if !why.is_empty() {
        return Err(why);
    }
    let lattices = sub_lattices(pair.size_px, pixels);
    if lattices.iter().any(|lattice| lattice.len() < FEWEST_PIXELS) {
        return Err("a sixteenth of so few pixels has no value of its own");
    }
    let of_one = |lattice: &Vec<usize>| match pair.answer(metric, sides, Some(lattice)) {
        Answer::Value(value, _) if value.is_finite() => Some(value),
        _ => None,
    };
    let values: Option<Vec<f64>> = lattices.iter().map(of_one).collect();
    let values = values.ok_or("it is not defined on every sixteenth of the pixels")?;
    let scatter = match metric.describe().better {
        Better::Lower => of_logarithms(value, &values),
        Better::Higher | Better::NearZero | Better::Neither => None,
    };
    scatter.or_else(|| of_values(value, &values)).ok_or("no sub-lattice")
}

/// Scatter of the values themselves.
fn of_values(value: f64, values: &[f64]) -> Option<(f64, f64)> {
    Some(Estimate { value, ..mean_of_samples(values)? }.interval(CONFIDENCE))
}

/// Errors are positive and lean to large values, so theirs is the scatter of their
/// logarithm, by leaving out one sub-lattice at a time: as wide by ratio on both sides.
/// Where errors have heavy tails the other covers 93 times in 100, and may reach below 0.
/// `None` where one sub-lattice carries the whole error.
fn of_logarithms(value: f64, values: &[f64]) -> Option<(f64, f64)> {
    let all: f64 = values.iter().sum();
    let others = values.iter().map(|own| (all - own) / (values.len() - 1) as f64);
    let without: Vec<f64> = others.map(f64::ln).collect();
    if !value.ln().is_finite() || without.iter().any(|log| !log.is_finite()) {
        return None;
    }
    let (low, high) = jackknife(value.ln(), &without)?.interval(CONFIDENCE);
    Some((low.exp(), high.exp()))
}

/// The pixels of each sub-lattice, of all or of some.
fn sub_lattices([width, height]: [usize; 2], pixels: Option<&[usize]>) -> Vec<Vec<usize>> {
    let mut lattices = vec![Vec::new(); COUNT];
    let mut place = |pixel: usize| {
        let (x, y) = (pixel % width, pixel / width);
        lattices[y % STEP * STEP + x % STEP].push(pixel);
    };
    match pixels {
        Some(pixels) => pixels.iter().copied().for_each(&mut place),
        None => (0..width * height).for_each(&mut place),
    }
    lattices
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use crate::metric::{Candidate, Encoding, Metric, Reference, Selection, judge};
    use scenes::noise::SplitMix64;
    use scenes::{LayerName, Layers};

    const SIZE: usize = 64;

    fn image(value: impl FnMut() -> f64) -> Layers {
        let mut layers = Layers::new([SIZE as u32; 2]);
        let data = std::iter::repeat_with(value).take(3 * SIZE * SIZE).collect();
        layers.push(LayerName::Radiance, 3, data);
        layers
    }

    fn measured(metric: Metric, reference: &Layers, candidate: &Layers) -> (f64, f64, f64) {
        let selection = Selection { metrics: vec![metric], ..Selection::all(Encoding::Linear) };
        let judged = judge(Reference(reference), Candidate(candidate), &selection).unwrap();
        let found = &judged.measurements[0];
        let (low, high) = found.interval.unwrap();
        (found.value.unwrap(), low, high)
    }

    /// Share of 4,000 pairs whose interval holds the expectation. Errors of a pixel are
    /// 0.1 times a draw, the same in its three channels.
    fn coverage(metric: Metric, truth: f64, mut draw: impl FnMut(&mut SplitMix64) -> f64) -> f64 {
        let zero = image(|| 1.0);
        let mut random = SplitMix64(7);
        let covered = (0..4000).filter(|_| {
            let mut channel = 0;
            let mut error = 0.0;
            let noisy = image(|| {
                if channel % 3 == 0 {
                    error = 0.1 * draw(&mut random);
                }
                channel += 1;
                1.0 + error
            });
            let (_, low, high) = measured(metric, &zero, &noisy);
            (low..=high).contains(&truth)
        });
        covered.count() as f64 / 4000.0
    }

    /// Light tails: normal errors of variance 0.01. Heavy ones: one pixel in fifty is ten
    /// times off, E d² = 0.01 (0.98 + 0.02 · 100).
    #[test]
    fn the_ci_of_the_squared_error_covers_its_expectation_19_times_in_20() {
        let light = coverage(Metric::Mse, 0.01, SplitMix64::normal);
        assert!((0.94..=0.99).contains(&light), "{light}");
        let heavy = |random: &mut SplitMix64| {
            let scale = if random.uniform() < 0.02 { 10.0 } else { 1.0 };
            scale * random.normal()
        };
        let heavy = coverage(Metric::Mse, 0.01 * (0.98 + 2.0), heavy);
        assert!((0.94..=0.99).contains(&heavy), "{heavy}");
        // The control: an expectation that is a twentieth off is not what it covers.
        let other = coverage(Metric::Mse, 0.0105, SplitMix64::normal);
        assert!(other < 0.8, "{other}");
    }

    /// One pixel that carries half of the error widens the interval to the whole value.
    #[test]
    fn a_value_that_one_pixel_makes_has_a_wide_interval() {
        let zero = image(|| 1.0);
        let even = image(|| 1.1);
        let mut glint = even.clone();
        glint.list[0].data[3 * (SIZE * 20 + 20)] = 1.0 + (0.01 * 3.0 * 4096.0_f64).sqrt();
        let width = |candidate: &Layers| {
            let (value, low, high) = measured(Metric::Mse, &zero, candidate);
            (high - low) / value
        };
        assert!(width(&even) < 1e-12);
        assert!(width(&glint) > 1.0, "{}", width(&glint));
    }
}
