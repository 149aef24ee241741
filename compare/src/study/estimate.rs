//! How long a study will take, asked of this machine before it starts: a small
//! image of each scene is traced and the time scaled up.

use super::Spec;
use super::place::PlaceWork;
use super::sweep::Grid;
use crate::Error;
use crate::study::cache::Store;
use crate::study::jobs::Exact;
use std::collections::BTreeMap;
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

/// What a study comes to. Each scene is asked once, as it was written; other numbers
/// in it are taken to cost as much.
pub(super) fn estimate(spec: &Spec, grid: &Grid, store: &Store) -> Estimate {
    let mut estimate = Estimate::default();
    let mut seconds = 0.0;
    let mut asked: BTreeMap<usize, Option<Cost>> = BTreeMap::new();
    for place in &grid.places {
        let scene = &spec.scenes[place.scene];
        let work = PlaceWork::new(spec, place, scene);
        let cost = asked.entry(place.scene).or_insert_with(|| cost(work.truth()).ok());
        // A scene that cannot be traced is left out, and says why when it is tried.
        let Some(Cost { built_s, per_ray_s }) = *cost else { continue };
        let known = |job: &&Exact| place.set.is_empty() && store.has(&job.id());
        let (stored, missing): (Vec<_>, Vec<_>) = work.exact().partition(known);
        let rays: f64 = missing.iter().map(|job| job.camera_rays()).sum();
        seconds += per_ray_s * rays + built_s * missing.len() as f64;
        let methods = place.jobs.len() - 1;
        let positions = work.truth().camera_rays();
        seconds += judging_seconds(methods, spec.timing_s, positions);
        estimate.exact_images += missing.len();
        estimate.stored_images += stored.len();
        estimate.pairs += methods;
    }
    estimate.duration = Duration::from_secs_f64(seconds);
    estimate
}

/// What tracing a scene takes on this machine.
#[derive(Clone, Copy)]
struct Cost {
    /// Seconds to build the scene, which every image pays once.
    built_s: f64,
    /// Seconds per camera ray.
    per_ray_s: f64,
}

fn cost(job: &Exact) -> Result<Cost, Error> {
    let built_s = probe(job, 1)?;
    let traced_s = probe(job, PROBE_PX)?;
    let rays = f64::from(PROBE_PX * PROBE_PX);
    Ok(Cost { built_s, per_ray_s: (traced_s - built_s).max(0.0) / rays })
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
fn judging_seconds(methods: usize, timing_s: f64, positions: f64) -> f64 {
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
