//! How long a study will take, asked of this machine before it starts: a small
//! image of each scene is traced and the time scaled up.

use crate::Error;
use crate::study::jobs::Exact;
use std::fmt;
use std::time::{Duration, Instant};

/// Edge of the probing image, pixels.
const PROBE_PX: u32 = 32;
/// Seconds per image for compiling shaders.
const COMPILING_S: f64 = 0.5;
/// Seconds per position in a pixel for drawing, reading back, metrics and writing,
/// on two processors with a software driver; others are faster.
const PER_POSITION_S: f64 = 0.75e-6;

/// What a study is going to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// Exact images to trace.
    pub exact_images: usize,
    /// Exact images that the store has already.
    pub stored_images: usize,
    /// Scene and method pairs to render and time.
    pub pairs: usize,
    /// How long all of it should take.
    pub duration: Duration,
}

/// Seconds that exact images of one scene should take on this machine; also
/// finds out whether the scene can be traced at all.
pub(super) fn seconds(jobs: &[&Exact]) -> Result<f64, Error> {
    let Some(first) = jobs.first() else { return Ok(0.0) };
    // One ray finds what it takes to build the scene, which every image pays once.
    let built = probe(first, 1)?;
    let traced = probe(first, PROBE_PX)?;
    let rays = f64::from(PROBE_PX * PROBE_PX);
    let per_ray = (traced - built).max(0.0) / rays;
    let rays: f64 = jobs.iter().map(|job| job.camera_rays()).sum();
    Ok(per_ray * rays + built * jobs.len() as f64)
}

/// Seconds for an image of that edge.
fn probe(job: &Exact<'_>, edge_px: u32) -> Result<f64, Error> {
    let mut probe = job.clone();
    probe.request.view.resolution_px = [edge_px; 2];
    probe.request.view.positions_per_axis = 1;
    let start = Instant::now();
    reference::render(probe.scene, &probe.request)?;
    Ok(start.elapsed().as_secs_f64())
}

/// Seconds that judging each of some methods should take, if it is timed for
/// `timing_s` and drawn at `positions` in all pixels together.
pub(super) fn judging_seconds(methods: usize, timing_s: f64, positions: f64) -> f64 {
    methods as f64 * (timing_s + COMPILING_S + PER_POSITION_S * positions)
}

impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seconds = self.duration.as_secs_f64();
        write!(
            f,
            "{} exact images to trace ({} more in the cache), {} method images to time: about ",
            self.exact_images, self.stored_images, self.pairs
        )?;
        if seconds < 90.0 {
            write!(f, "{:.0} s", seconds.ceil())
        } else {
            write!(f, "{:.0} min", (seconds / 60.0).ceil())
        }
    }
}
