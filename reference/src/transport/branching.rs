//! Which continuations of an event are followed.

use crate::sampling::sobol::Points;

/// Weights with which an event's two continuations go on; 0: not followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Choice {
    pub(crate) reflected: f64,
    pub(crate) transmitted: f64,
    /// Weight that was dropped for good.
    pub(crate) lost: f64,
}

/// Decides at every event.
pub(crate) trait Policy {
    /// * `weights`: of the reflected and the transmitted continuation.
    /// * `present`: transmittance of the path so far, 0 to 1.
    fn choose(&mut self, weights: [f64; 2], present: f64) -> Choice;
}

/// Follows everything whose weight is at least the cut. The stronger
/// continuation may be up to 1024 times weaker before it is dropped too: it
/// mostly leads out, so that what is lost is a small share of what is followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut(pub(crate) f64);

impl Policy for Cut {
    #[inline(always)]
    fn choose(&mut self, [reflected, transmitted]: [f64; 2], present: f64) -> Choice {
        let keep = |mine: f64, other: f64| {
            let least = if mine >= other { self.0 / 1024.0 } else { self.0 };
            if mine * present >= least { mine } else { 0.0 }
        };
        let kept = [keep(reflected, transmitted), keep(transmitted, reflected)];
        let lost = (reflected - kept[0]) + (transmitted - kept[1]);
        Choice { reflected: kept[0], transmitted: kept[1], lost: lost * present }
    }
}

/// Follows both continuations of an event, a weak one only by chance, and just one
/// of them once the path itself is weak; ends absorbed paths at random. The
/// expectation is that of following everything.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Roulette {
    points: Points,
    sample: u32,
    /// Weight from which on a continuation is strong.
    split: f64,
    /// Random numbers drawn so far.
    drawn: u32,
    kept: f64,
}

/// Throughput below which a path must survive a draw.
const FADED: f64 = 1.0 / 64.0;

impl Roulette {
    /// The first pair of dimensions is the caller's, for the position.
    pub(crate) fn new(points: Points, sample: u32, split: f64) -> Self {
        Self { points, sample, split, drawn: 2, kept: 0.0 }
    }

    fn draw(&mut self) -> f64 {
        let second = self.drawn % 2 == 1;
        if !second {
            let [first, next] = self.points.pair(self.sample, self.drawn / 2);
            self.kept = next;
            self.drawn += 1;
            return first;
        }
        self.drawn += 1;
        self.kept
    }
}

impl Policy for Roulette {
    fn choose(&mut self, weights: [f64; 2], present: f64) -> Choice {
        let [reflected, transmitted] = if (weights[0] + weights[1]) * present >= 2.0 * self.split {
            self.branch(weights, present)
        } else {
            self.one_way(weights, present)
        };
        Choice { reflected, transmitted, lost: 0.0 }
    }
}

impl Roulette {
    /// Follows the stronger continuation and, if it is strong or chance makes it
    /// so, the weaker one. Both together keep their weight, and none is left weak.
    fn branch(&mut self, weights: [f64; 2], present: f64) -> [f64; 2] {
        let weak = usize::from(weights[1] < weights[0]);
        let likely = weights[weak] * present / self.split;
        if likely >= 1.0 {
            return weights;
        }
        let weight = if self.draw() < likely { self.split / present } else { 0.0 };
        let mut chosen = [weights[0] + weights[1] - weight; 2];
        chosen[weak] = weight;
        chosen
    }

    /// Follows one continuation, and not even that where the path has faded.
    fn one_way(&mut self, [reflected, transmitted]: [f64; 2], present: f64) -> [f64; 2] {
        let whole = reflected + transmitted;
        let mut weight = whole;
        // Paths that follow one continuation keep their weight, so only
        // absorption fades them.
        let survival = (whole * present / FADED.min(0.5 * self.split)).min(1.0);
        if survival < 1.0 {
            if self.draw() >= survival {
                return [0.0; 2];
            }
            weight /= survival;
        }
        let back = reflected > 0.0 && self.draw() * whole < reflected;
        if back { [weight, 0.0] } else { [0.0, weight] }
    }
}
