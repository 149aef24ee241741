//! How often the gate alarms when it should not, and how often when it should.
//!
//! The truths, and methods that draw random numbers, are drawn from a stated
//! noise model, seeded: each of K batches scatters about the mean with a
//! coefficient of variation cv, by a normal deviate (light) or by a gamma deviate
//! of shape 1/cv² (heavy tails, and never negative, as radiance is).

#![allow(clippy::print_stdout, reason = "`--nocapture` shows how often")]

use super::difference::{Truth, corrected_relmse, of_relmse};
use super::verdict::{Outcome, Question, Rule, decide};
use crate::metric::stack::mean_image;
use crate::support::statistics::Correction;
use scenes::noise::SplitMix64;

const SIDE: usize = 24;
const VALUES: usize = 3 * SIDE * SIDE;
const REPETITIONS: u64 = 200;

#[derive(Clone, Copy, Debug)]
enum Noise {
    Light,
    Heavy,
}

impl Noise {
    /// A factor with mean 1 and deviation cv.
    fn factor(self, cv: f64, random: &mut SplitMix64) -> f64 {
        match self {
            Self::Light => 1.0 + cv * random.normal(),
            Self::Heavy => cv * cv * gamma(1.0 / (cv * cv), random),
        }
    }

    fn image(self, mean: &[f64], cv: f64, random: &mut SplitMix64) -> Vec<f64> {
        // The channels of a pixel see the same paths.
        let pixel = |m: &[f64]| {
            let factor = self.factor(cv, random);
            [0, 1, 2].map(|c| m[c] * factor)
        };
        mean.chunks_exact(3).flat_map(pixel).collect()
    }
}

/// A gamma deviate of scale 1. Source: Marsaglia & Tsang, *ACM Transactions on
/// Mathematical Software* 26(3), 2000.
fn gamma(shape: f64, random: &mut SplitMix64) -> f64 {
    if shape < 1.0 {
        let uniform = 1.0 - random.uniform();
        return gamma(shape + 1.0, random) * uniform.powf(1.0 / shape);
    }
    let d = shape - 1.0 / 3.0;
    let c = 1.0 / (9.0 * d).sqrt();
    loop {
        let x = random.normal();
        let v = (1.0 + c * x).powi(3);
        let u: f64 = 1.0 - random.uniform();
        if v > 0.0 && u.ln() < 0.5 * x * x + d - d * v + d * v.ln() {
            return d * v;
        }
    }
}

/// A picture with dark and bright parts, 0.02 to 5.
fn exact() -> Vec<f64> {
    let value = |i: usize| {
        let (x, y) = ((i / 3 % SIDE) as f64, (i / 3 / SIDE) as f64);
        let wave = (0.7 * x).sin() * (0.4 * y + i as f64 % 3.0).cos();
        0.02 + 5.0 * (0.5 + 0.5 * wave).powi(4)
    };
    (0..VALUES).map(value).collect()
}

/// A method's image: wrong by up to a third, differently from place to place.
fn method(exact: &[f64]) -> Vec<f64> {
    exact.iter().enumerate().map(|(i, r)| r * (1.0 + 0.33 * (0.9 * i as f64).sin())).collect()
}

/// Mean of K batches and its standard error per value.
fn truth(exact: &[f64], noise: Noise, cv: f64, k: u32, random: &mut SplitMix64) -> [Vec<f64>; 2] {
    let batches: Vec<Vec<f64>> = (0..k).map(|_| noise.image(exact, cv, random)).collect();
    let views: Vec<&[f64]> = batches.iter().map(Vec::as_slice).collect();
    let mean = mean_image(&views);
    let error = |i: usize| {
        let squares: f64 = batches.iter().map(|batch| (batch[i] - mean[i]).powi(2)).sum();
        (squares / f64::from(k - 1) / f64::from(k)).sqrt()
    };
    let error = (0..mean.len()).map(error).collect();
    [mean, error]
}

/// Repetitions with this outcome, each with a fresh truth, fresh seeds of both
/// sides and the margin given as a share of base's error.
fn count(
    outcome: Outcome,
    rule: Rule,
    margin: f64,
    mut pair: impl FnMut(&mut SplitMix64) -> ([Vec<f64>; 2], Vec<Vec<f64>>, Vec<Vec<f64>>),
) -> u32 {
    let frozen = exact();
    let mut found = 0;
    for seed in 0..REPETITIONS {
        let ([mean, error], head, base) = pair(&mut SplitMix64(seed));
        let truth = Truth { mean: &mean, standard_error: Some(&error), frozen: &frozen };
        let head: Vec<&[f64]> = head.iter().map(Vec::as_slice).collect();
        let base: Vec<&[f64]> = base.iter().map(Vec::as_slice).collect();
        let Some(difference) = of_relmse(&truth, &head, &base) else { continue };
        let of_base = corrected_relmse(&truth, base[0]);
        let question = Question {
            cell: "made up".to_owned(),
            metric: "relmse".to_owned(),
            base: of_base,
            head: of_base + difference.value,
            difference,
            margin: margin * of_base.max(0.0),
        };
        found += u32::from(decide(&[question], rule)[0].outcome == outcome);
    }
    found
}

/// 5 seeds of a method whose image scatters by `cv`.
fn seeds(image: &[f64], noise: Noise, cv: f64, random: &mut SplitMix64) -> Vec<Vec<f64>> {
    (0..5).map(|_| noise.image(image, cv, random)).collect()
}

/// At a level of 1 %, an unchanged method alarms at most 5 times in 200, with no
/// margin at all; at a level of 20 % it alarms 20 to 60 times, so that the first
/// does not pass for want of any alarm.
#[test]
fn an_unchanged_method_alarms_as_rarely_as_the_level_says() {
    let (exact, image) = (exact(), method(&exact()));
    for noise in [Noise::Light, Noise::Heavy] {
        let unchanged = |random: &mut SplitMix64| {
            let truth = truth(&exact, noise, 0.5, 16, random);
            let head = seeds(&image, noise, 0.3, random);
            (truth, head, seeds(&image, noise, 0.3, random))
        };
        let at = |level| {
            let rule = Rule { level, correction: Correction::Holm };
            count(Outcome::Fail, rule, 0.0, unchanged)
        };
        let (strict, loose) = (at(0.01), at(0.2));
        println!("{noise:?}: {strict} alarms of 200 at 1 %, {loose} at 20 %");
        assert!(strict <= 5, "{noise:?}: {strict}");
        assert!((20..=60).contains(&loose), "{noise:?}: {loose}");
    }
}

/// head + c (test - exact), c so that relMSE grows by exactly 5 %, is caught in
/// at least 190 of 200; by 1 % with a margin of 2 %, never.
#[test]
fn five_per_cent_more_error_is_caught_and_one_per_cent_is_not() {
    let (exact, image) = (exact(), method(&exact()));
    for (noise, cv) in [(Noise::Light, 0.2), (Noise::Heavy, 0.2), (Noise::Heavy, 0.5)] {
        let grown = |by: f64| {
            let c = (1.0 + by).sqrt() - 1.0;
            let head: Vec<f64> = image.iter().zip(&exact).map(|(t, r)| t + c * (t - r)).collect();
            let (exact, image) = (&exact, &image);
            count(Outcome::Fail, Rule::default(), 0.02, move |random| {
                let truth = truth(exact, noise, cv, 16, random);
                (truth, vec![head.clone()], vec![image.clone()])
            })
        };
        let (caught, false_alarms) = (grown(0.05), grown(0.01));
        println!("{noise:?}, cv {cv}: {caught} of 200 caught at 5 %, {false_alarms} at 1 %");
        assert!(caught >= 190, "{noise:?} {cv}: {caught}");
        assert_eq!(false_alarms, 0, "{noise:?} {cv}");
    }
}

/// An estimate of a change just at the margin is above it half of the time: the level holds
/// there too, and not only where nothing changed.
#[test]
fn a_change_as_large_as_the_margin_alarms_no_more_often_than_the_level_says() {
    let (exact, image) = (exact(), method(&exact()));
    let c = 1.02f64.sqrt() - 1.0;
    let head: Vec<f64> = image.iter().zip(&exact).map(|(t, r)| t + c * (t - r)).collect();
    let at_margin = |random: &mut SplitMix64| {
        let truth = truth(&exact, Noise::Heavy, 0.5, 16, random);
        (truth, vec![head.clone()], vec![image.clone()])
    };
    let alarms = count(Outcome::Fail, Rule::default(), 0.02, at_margin);
    println!("{alarms} alarms of 200 for a change of just the margin");
    assert!(alarms <= 5, "{alarms}");
}

/// A truth of few, very noisy batches cannot tell, and says so; one of many can.
#[test]
fn a_truth_that_is_too_noisy_is_inconclusive() {
    let (exact, image) = (exact(), method(&exact()));
    let head: Vec<f64> = image.iter().zip(&exact).map(|(t, r)| t + 0.2 * (t - r)).collect();
    let better = |batches: u32, cv: f64| {
        let (exact, image, head) = (&exact, &image, &head);
        // Head and base change places: an improvement, so that nothing fails.
        count(Outcome::Inconclusive, Rule::default(), 0.02, move |random| {
            let truth = truth(exact, Noise::Heavy, cv, batches, random);
            (truth, vec![image.clone()], vec![head.clone()])
        })
    };
    assert_eq!(better(4, 2.0), 200);
    assert_eq!(better(64, 0.1), 0);
}
