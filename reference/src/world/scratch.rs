//! What a thread keeps while it follows rays.

use super::crossing::Crossing;
use super::winding::{Indices, Winding};
use crate::geometry::bvh::Stack;
use scenes::MediumId;

/// Working memory of one thread and its counts of work.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch {
    pub(crate) stack: Stack,
    pub(crate) crossings: Vec<Crossing>,
    pub(crate) splits: Vec<Split>,
    /// Metres of the last flight in each medium, in its order, if asked for.
    pub(crate) stretches: Vec<(MediumId, f64)>,
    pub(crate) counters: Counters,
}

/// How many crossings of a class lie behind the ray.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Split {
    pub(crate) skip: usize,
    pub(crate) seen: usize,
}

/// Deterministic counts of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counters {
    /// Rays sent through the tree.
    pub(crate) rays: u64,
    /// Events that bent or reflected light.
    pub(crate) events: u64,
    /// Flights that went the long way.
    pub(crate) settled: u64,
    /// Of those, flights whose winding had to follow the geometry.
    pub(crate) reconciled: u64,
    /// Paths that reached the environment while inside a body.
    pub(crate) left_inside: u64,
    /// Paths that met the limit on events.
    pub(crate) capped: u64,
}

impl Counters {
    pub(crate) fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.events += other.events;
        self.settled += other.settled;
        self.reconciled += other.reconciled;
        self.left_inside += other.left_inside;
        self.capped += other.capped;
    }
}

impl Scratch {
    /// Notes a stretch of the way.
    #[inline(always)]
    pub(crate) fn note<W: Winding, const LENGTHS: bool>(
        &mut self,
        indices: &Indices,
        winding: &W,
        length_m: f64,
    ) {
        if LENGTHS && length_m > 0.0 {
            self.stretches.push((indices.medium(winding), length_m));
        }
    }
}
