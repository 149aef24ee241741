//! Random numbers to aim with.

use glam::DVec3;
use scenes::noise::SplitMix64;
use std::f64::consts::TAU;

/// A seeded sequence of choices; the same seed gives the same ones.
#[derive(Clone, Debug)]
pub struct Dice(SplitMix64);

impl Dice {
    /// The sequence of that seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(SplitMix64(seed))
    }

    /// From 0 up to but not including 1.
    pub fn unit(&mut self) -> f64 {
        self.0.uniform()
    }

    /// A whole number below `count`.
    pub fn pick(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    /// A point in the cube from -1 to 1.
    pub fn point(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit()) * 2.0 - 1.0
    }

    /// A unit vector, all directions alike.
    pub fn direction(&mut self) -> DVec3 {
        let z = 2.0 * self.unit() - 1.0;
        let turn = self.unit() * TAU;
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * turn.cos(), r * turn.sin(), z)
    }
}
