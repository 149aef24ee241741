//! A study: every method on every scene, against the exact answer.
//!
//! Read this first: [`run`] is the whole of it, in order. Exact images come out
//! of the store if they were ever made there; approximations are rendered and
//! timed anew, because a time is a measurement, not a result that can be kept.
//! Whatever is judged has been through the store's files, so a cold and a warm
//! study give the same numbers.

pub mod cache;
mod estimate;
pub mod jobs;
mod judge;
mod output;
mod scene_work;
mod summary;

pub use estimate::Estimate;
pub use summary::summary;

use crate::Error;
use crate::results::{NotDone, REFERENCE, ResultRow, STUDY_SCHEMA, Study};
use crate::study::cache::Store;
use crate::support::progress::Progress;
use crate::support::utc;
use realtime::Gpu;
use scene_work::SceneWork;
use scenes::Scene;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// What a study is asked.
#[derive(Debug)]
pub struct Spec {
    /// Scenes, in the order of the report.
    pub scenes: Vec<Scene>,
    /// Ids of methods, in the order of the report.
    pub methods: Vec<String>,
    /// What was asked for and cannot be done.
    pub left_out: Vec<NotDone>,
    /// Image size; `None`: each scene's own.
    pub resolution_px: Option<[u32; 2]>,
    /// k of the k x k positions per pixel on both sides.
    pub positions_per_axis: u32,
    /// Branches of the exact tree below this weight are cut.
    pub cut: f64,
    /// Seconds for which each method is timed.
    pub timing_s: f64,
    /// Time each frame a second time with everything kept, to say what leaving out
    /// saves, and trace the last point of the exact renderer's own curve.
    pub thorough: bool,
    /// Where results and report go.
    pub out: PathBuf,
    /// Command line that repeats the study.
    pub command: String,
}

/// Renders, judges, and writes the results to `spec.out`.
///
/// `announce` is told the estimate before the work starts.
///
/// # Errors
/// If the store or the output cannot be used, or nothing at all could be done.
pub fn run(
    spec: &Spec,
    gpu: &Gpu,
    store: &Store,
    announce: impl FnOnce(&Estimate),
) -> Result<(Study, Vec<ResultRow>), Error> {
    let start = Instant::now();
    let mut study = begin(spec, gpu);
    let mut work: Vec<_> = spec.scenes.iter().map(|scene| SceneWork::new(scene, spec)).collect();
    announce(&estimate(&mut work, spec, store, &mut study.left_out));

    let progress = Progress::new("");
    let mut rows = Vec::new();
    for (done, scene) in work.iter().enumerate() {
        let share = |share: f64| progress.at((done as f64 + share) / work.len() as f64);
        let traced = scene.trace(store, &|name| progress.now(name), &share)?;
        scene.judge(&traced, spec, gpu, &|name| progress.now(name), &mut study, &mut rows)?;
    }
    drop(progress);
    if study.runs.iter().all(|run| run.method == REFERENCE) {
        return Err(Error::NothingDone(study.left_out));
    }
    study.finished_utc = utc::now();
    study.elapsed_s = start.elapsed().as_secs_f64();
    output::write(&spec.out, &study, &rows)?;
    Ok((study, rows))
}

/// A study that has everything but its results.
fn begin(spec: &Spec, gpu: &Gpu) -> Study {
    let adapter = gpu.info();
    let clock = if adapter.software { "time_wall_ms" } else { "time_timestamp_ms" };
    Study {
        schema: STUDY_SCHEMA.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        command: spec.command.clone(),
        adapter: adapter.name.clone(),
        driver: adapter.driver.clone(),
        software: adapter.software,
        time_metric: clock.to_owned(),
        left_out: spec.left_out.clone(),
        ..Study::default()
    }
}

/// What there is to do. Scenes that cannot be traced are taken out of the work
/// and noted with the reason.
fn estimate(
    work: &mut Vec<SceneWork>,
    spec: &Spec,
    store: &Store,
    left_out: &mut Vec<NotDone>,
) -> Estimate {
    let mut estimate = Estimate::default();
    let mut seconds = 0.0;
    work.retain(|scene| {
        let (stored, missing): (Vec<_>, Vec<_>) =
            scene.exact().partition(|job| store.has(&job.id()));
        match estimate::seconds(&missing) {
            Ok(more) => {
                let positions = scene.truth().camera_rays();
                seconds += more;
                seconds += estimate::judging_seconds(spec.methods.len(), spec.timing_s, positions);
                estimate.exact_images += missing.len();
                estimate.stored_images += stored.len();
                true
            }
            Err(reason) => {
                left_out.push(NotDone { what: scene.name(), reason: reason.to_string() });
                false
            }
        }
    });
    estimate.pairs = work.len() * spec.methods.len();
    estimate.duration = Duration::from_secs_f64(seconds);
    estimate
}
