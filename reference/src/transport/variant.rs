//! Which compiled form of the tracer a scene needs.

use crate::request::Keep;
use crate::world::World;
use crate::world::winding::{Counts, InOrOut, Winding};
use scenes::{Environment, Scene};

/// Compile-time features of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Variant {
    /// Winding counts to carry; 0 for a single convex body.
    pub(crate) classes: usize,
    /// The environment is the same everywhere.
    pub(crate) uniform: bool,
    /// Lengths per medium are needed.
    pub(crate) lengths: bool,
}

/// What is compiled for each combination that can be chosen.
pub(crate) trait Specialised {
    type Output;

    fn run<W, const UNIFORM: bool, const LENGTHS: bool>(self) -> Self::Output
    where
        W: Winding + Send + Sync;
}

impl Variant {
    /// * `shows_lengths`: what is asked for holds lengths per medium.
    pub(crate) fn new(scene: &Scene, world: &World, keep: Keep, shows_lengths: bool) -> Self {
        if keep == Keep::Everything {
            return Self { classes: 256, uniform: false, lengths: true };
        }
        let absorbs = scene.media.iter().any(scenes::Medium::absorbs);
        Self {
            classes: if world.is_one_convex_body() { 0 } else { world.classes.len().max(1) },
            uniform: matches!(scene.environment, Environment::Uniform(_)),
            lengths: absorbs || shows_lengths,
        }
    }

    /// Runs what is compiled for this variant.
    pub(crate) fn run<T: Specialised>(self, task: T) -> T::Output {
        match self.classes {
            0 => self.run_with::<T, InOrOut>(task),
            1 => self.run_with::<T, Counts<1>>(task),
            2..=4 => self.run_with::<T, Counts<4>>(task),
            5..=16 => self.run_with::<T, Counts<16>>(task),
            _ => self.run_with::<T, Counts<256>>(task),
        }
    }

    fn run_with<T: Specialised, W: Winding + Send + Sync>(self, task: T) -> T::Output {
        match (self.uniform, self.lengths) {
            (false, false) => task.run::<W, false, false>(),
            (false, true) => task.run::<W, false, true>(),
            (true, false) => task.run::<W, true, false>(),
            (true, true) => task.run::<W, true, true>(),
        }
    }
}
