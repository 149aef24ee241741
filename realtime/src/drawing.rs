//! Draws a frame at all positions in its pixels, any number of times.

use crate::drawn::frame_uniforms::Viewed;
use crate::error::Error;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::gpu::recorder::{Executed, Recorder};
use crate::request::Timing;
use glam::DVec2;
use std::time::Instant;

/// A frame, and the positions in its pixels.
pub(crate) struct Drawing<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) frame: &'a Frame,
    pub(crate) view: Viewed<'a>,
    /// As [`Viewed::shift`].
    pub(crate) shifts: &'a [DVec2],
}

/// A median has a middle.
const FEWEST_FRAMES: usize = 3;
/// Frames that are slow may be timed this many times as long as was asked for, until
/// there are enough of them.
const MOST_TIMES_AS_LONG: f64 = 10.0;

impl Drawing<'_> {
    /// Draws it at one position after the other, and does something after each.
    /// `first`: also what never changes.
    pub(crate) fn once(
        &self,
        timed: bool,
        first: bool,
        mut after_each: impl FnMut() -> Result<(), Error>,
    ) -> Result<Executed, Error> {
        let mut executed = Executed::default();
        for (index, shift) in self.shifts.iter().enumerate() {
            self.frame.aim(self.gpu, &Viewed { shift: *shift, ..self.view });
            let mut recorder = Recorder::new(self.gpu, timed);
            self.frame.record(&mut recorder, first && index == 0);
            executed.then(recorder.finish()?);
            after_each()?;
        }
        Ok(executed)
    }

    /// What a frame after the first does, and the times of those that count. What
    /// never changes is drawn once, as a game would.
    pub(crate) fn timed(&self, timing: Timing) -> Result<(Vec<String>, Vec<Executed>), Error> {
        let again = || self.once(true, false, || Ok(()));
        self.once(false, true, || Ok(()))?;
        let second = again()?;
        let passes = second.passes.clone();
        for _ in 2..timing.warm_up {
            again()?;
        }
        let started = Instant::now();
        let mut frames: Vec<_> = (timing.warm_up < 2).then_some(second).into_iter().collect();
        let goes_on = |frames: usize| {
            let elapsed_s = started.elapsed().as_secs_f64();
            let too_few = frames < timing.min_frames as usize;
            let wanted_s = timing.seconds * if too_few { MOST_TIMES_AS_LONG } else { 1.0 };
            elapsed_s < wanted_s && frames < timing.max_frames as usize
        };
        while frames.len() < FEWEST_FRAMES || goes_on(frames.len()) {
            frames.push(again()?);
        }
        Ok((passes, frames))
    }
}
