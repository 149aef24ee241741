//! A study: every method on every scene, against the exact answer.
//!
//! Read this first: what a study asks expands into a grid of jobs ([`sweep`]), each
//! job comes to an [`Outcome`] wherever it is done, and outcomes gather into results
//! and a report. [`run`] is the whole of it in one process; [`shelf`] is the same
//! over many. Exact images come out of the store if they were ever made there;
//! approximations are rendered and timed anew, because a time is a measurement, not
//! a result that can be kept. Whatever is judged has been through the store's files,
//! so a cold and a warm study give the same numbers.

pub mod added;
pub mod cache;
mod estimate;
mod external;
mod gather;
pub mod jobs;
mod judge;
mod output;
mod place;
mod readings;
pub mod shelf;
mod summary;
pub mod sweep;

pub use estimate::Estimate;
pub use summary::summary;

use crate::Error;
use crate::results::{NotDone, REFERENCE, ResultRow, Run, STUDY_SCHEMA, SceneEntry, Study};
use crate::study::cache::{Id, Store};
use crate::support::files::FileError;
use crate::support::progress::Progress;
use crate::support::utc;
use gather::Gallery;
use place::{Bench, PlaceWork};
use realtime::Gpu;
use scenes::Scene;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::Instant;
use sweep::{Axes, External, Job, Place, Sweep};

/// What a study is asked.
#[derive(Debug)]
pub struct Spec {
    /// Scenes, in the order of the report.
    pub scenes: Vec<Scene>,
    /// Ids of methods, in the order of the report.
    pub methods: Vec<String>,
    /// What was asked for and cannot be done.
    pub left_out: Vec<NotDone>,
    /// What varies everywhere.
    pub axes: Axes,
    /// What varies of some.
    pub sweeps: Vec<Sweep>,
    /// Images of others.
    pub externals: Vec<External>,
    /// k of the k x k positions per pixel on both sides.
    pub positions_per_axis: u32,
    /// Branches of the exact tree below this weight are cut.
    pub cut: f64,
    /// Seconds for which each method is timed.
    pub timing_s: f64,
    /// Time each frame a second time with everything kept, to say what leaving out
    /// saves, and trace the last point of the exact renderer's own curve.
    pub thorough: bool,
    /// Milliseconds within which the best method is asked for.
    pub budget_ms: Option<f64>,
}

/// What a job came to. Its images are files in a folder of its own.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Outcome {
    /// The place, of exact jobs.
    pub entry: Option<SceneEntry>,
    /// The image; `None` if there is none.
    pub run: Option<Run>,
    /// Numbers.
    pub rows: Vec<ResultRow>,
    /// What could not be done.
    pub left_out: Vec<NotDone>,
    /// Driver of the GPU, name and version; empty where none was used.
    pub driver: String,
}

/// What does jobs: where exact images are kept, and the GPU if methods are among them.
pub(crate) struct Means<'a> {
    pub(crate) spec: &'a Spec,
    pub(crate) gpu: Option<&'a Gpu>,
    pub(crate) cache: &'a Store,
    /// Told what is being done.
    pub(crate) now: &'a dyn Fn(&str),
    /// Told the share of the place's exact image that is traced, 0 to 1.
    pub(crate) share: &'a (dyn Fn(f64) + Sync),
}

/// Takes what a job came to, with the folder that holds its files for the moment.
pub(crate) type Deliver<'a> = dyn FnMut(&Job, &Path, Outcome) -> Result<(), Error> + 'a;

/// Renders, judges, and writes the results to a folder.
///
/// `announce` is told the estimate before the work starts; `command` repeats it.
///
/// # Errors
/// If the axes make no sense, the store or the output cannot be used, or nothing at
/// all could be done.
pub fn run(
    spec: &Spec,
    gpu: &Gpu,
    store: &Store,
    out: &Path,
    command: &str,
    announce: impl FnOnce(&Estimate),
) -> Result<(Study, Vec<ResultRow>), Error> {
    let start = Instant::now();
    let grid = sweep::expand(spec)?;
    sweep::check(spec, &grid)?;
    announce(&estimate::estimate(spec, &grid, store));
    let progress = Progress::new("");
    let mut gallery = Gallery::of_places(grid.places.len(), out);
    std::fs::create_dir_all(out).map_err(FileError::of(out, "cannot be made"))?;
    let count = grid.places.len();
    for (done, place) in grid.places.iter().enumerate() {
        let now = |name: &str| progress.now(name);
        let share = |share: f64| progress.at((done as f64 + share) / count as f64);
        let means = Means { spec, gpu: Some(gpu), cache: store, now: &now, share: &share };
        let mut deliver =
            |job: &Job, folder: &Path, outcome| gallery.take(&job.method, done, folder, outcome);
        do_jobs(&means, place, &|_| true, out, &mut deliver)?;
    }
    drop(progress);
    let info = gpu.info();
    let study = Study {
        command: command.to_owned(),
        adapter: info.name.clone(),
        driver: info.driver.clone(),
        software: info.software,
        left_out: spec.left_out.clone(),
        budget_ms: spec.budget_ms,
        ..begin()
    };
    let elapsed_s = start.elapsed().as_secs_f64();
    gallery.finish(Study { elapsed_s, ..study })
}

/// A study that has everything but its results.
fn begin() -> Study {
    Study {
        schema: STUDY_SCHEMA.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        finished_utc: utc::now(),
        ..Study::default()
    }
}

/// Does the chosen jobs of a place, in their order; each in a folder of its own
/// inside `within`, which is gone once it has been delivered.
pub(crate) fn do_jobs(
    means: &Means,
    place: &Place,
    chosen: &dyn Fn(&Id) -> bool,
    within: &Path,
    deliver: &mut Deliver,
) -> Result<(), Error> {
    let jobs: Vec<&Job> = place.jobs.iter().filter(|job| chosen(&job.id)).collect();
    if jobs.is_empty() {
        return Ok(());
    }
    let folder = || {
        let folder = tempfile::Builder::new().prefix(".job-").tempdir_in(within);
        folder.map_err(FileError::of(within, "cannot be written"))
    };
    let base = &means.spec.scenes[place.scene];
    let scene = base.with(&place.set)?;
    let work = PlaceWork::new(means.spec, place, &scene);
    (means.now)(&format!("{}: tracing", place.label));
    let turn = means.cache.turn(&work.truth().id())?;
    let traced = work.truth().make(means.cache, means.share);
    drop(turn);
    let truth = match traced {
        Ok(truth) => truth,
        Err(Error::Reference(reason)) => {
            for job in jobs {
                deliver(job, folder()?.path(), untraced(place, job, &reason.to_string()))?;
            }
            return Ok(());
        }
        Err(error) => return Err(error),
    };
    let judge = work.judge(&truth)?;
    let (store, gpu) = (means.cache, means.gpu);
    let bench = Bench { work: &work, truth: &truth, judge: &judge, store, gpu };
    for job in jobs {
        (means.now)(&format!("{}: {}", place.label, job.method));
        let folder = folder()?;
        let outcome = bench.outcome(job, means.share, folder.path())?;
        deliver(job, folder.path(), outcome)?;
    }
    Ok(())
}

/// A place without a truth has nothing to judge by; its exact job says why.
fn untraced(place: &Place, job: &Job, reason: &str) -> Outcome {
    let mut outcome = Outcome::default();
    if job.method == REFERENCE {
        outcome.left_out.push(NotDone { what: place.label.clone(), reason: reason.to_owned() });
    }
    outcome
}
