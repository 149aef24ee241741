//! One piece of a study, named by a hash of everything that it is asked.

use super::{Place, Variant};
use crate::results::{Columns, REFERENCE, Scalar};
use crate::study::Spec;
use crate::study::cache::Id;
use realtime::Method;
use serde::Serialize;
use std::collections::BTreeMap;

/// What a job does.
#[derive(Clone, Debug, PartialEq)]
pub enum Task {
    /// Traces the exact image and the exact renderer's own curve.
    Exact,
    /// Draws, judges and times a method.
    Method(Variant),
    /// Judges the image of somebody else: its place in the study's list.
    External(usize),
}

/// A job that can be done anywhere, any number of times, with the same result.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// Hash of what is asked, of the version and of the sources.
    pub id: Id,
    /// Place among the jobs of the study, from 0.
    pub order: usize,
    /// Name of the scene.
    pub scene: String,
    /// Method id, the name of an external image, or `reference`.
    pub method: String,
    /// `param.…` and `scene.…`.
    pub columns: Columns,
    /// Width and height, pixels.
    pub resolution_px: [u32; 2],
    /// k of the k x k positions per pixel.
    pub positions: u32,
    /// What it does.
    pub task: Task,
}

/// Everything that the result of a job depends on.
#[derive(Serialize)]
struct Asked<'a> {
    version: &'a str,
    sources: [&'a str; 2],
    name: &'a str,
    /// Hash of the scene's text and files, before numbers are set in it.
    scene: &'a str,
    set: &'a BTreeMap<String, f64>,
    resolution_px: [u32; 2],
    positions: u32,
    cut: f64,
    timing_s: f64,
    thorough: bool,
    method: &'a str,
    /// Of a method from a user's file, or hash of an external image.
    text: Option<&'a str>,
    param: &'a BTreeMap<String, Scalar>,
    supersampling: &'a [u32],
    milliseconds: Option<f64>,
}

/// The job of a task at a place; `of_image` is the hash of an external image.
pub(super) fn job(spec: &Spec, place: &Place, task: Task, of_image: Option<&str>) -> Job {
    let scene = &spec.scenes[place.scene];
    let nothing = BTreeMap::new();
    let external = |index: &usize| spec.externals.get(*index);
    let (method, param, supersampling): (&str, _, &[u32]) = match &task {
        Task::Exact => (REFERENCE, &nothing, &[]),
        Task::Method(variant) => (&variant.method, &variant.param, &variant.supersampling),
        Task::External(index) => (external(index).map_or("", |e| &e.name), &nothing, &[]),
    };
    let of_file = Method::find(method).ok().and_then(Method::file_text);
    let gpu = if matches!(task, Task::Method(_)) { env!("SNELL_REALTIME_SOURCES") } else { "" };
    let asked = Asked {
        version: env!("CARGO_PKG_VERSION"),
        sources: [env!("SNELL_EXACT_SOURCES"), gpu],
        name: &scene.name,
        scene: &scene.source.sha256,
        set: &place.set,
        resolution_px: place.resolution_px,
        positions: spec.positions_per_axis,
        cut: spec.cut,
        timing_s: spec.timing_s,
        thorough: spec.thorough,
        method,
        text: of_image.or(of_file),
        param,
        supersampling,
        milliseconds: match &task {
            Task::External(index) => external(index).and_then(|e| e.milliseconds),
            _ => None,
        },
    };
    Job {
        id: Id::of(&asked),
        order: 0,
        scene: scene.name.clone(),
        method: method.to_owned(),
        columns: Columns::new(param, &place.set),
        resolution_px: place.resolution_px,
        positions: spec.positions_per_axis,
        task,
    }
}

/// A job as `snell jobs` prints it.
#[derive(Serialize)]
struct Line<'a> {
    schema: &'static str,
    id: &'a str,
    order: usize,
    kind: &'static str,
    scene: &'a str,
    method: &'a str,
    #[serde(flatten)]
    columns: &'a Columns,
    width_px: u32,
    height_px: u32,
    positions: u32,
    supersampling: &'a [u32],
    /// What the job takes while it runs: one processor or GPU to itself where it
    /// is timed.
    resources: BTreeMap<&'static str, u32>,
}

/// Schema of a line of `snell jobs`.
const JOB_SCHEMA: &str = "snell.job/1";

impl Job {
    /// True if the job needs a GPU and nothing else beside it.
    #[must_use]
    pub fn is_timed_on_gpu(&self) -> bool {
        matches!(self.task, Task::Method(_))
    }

    /// The job as one flat object.
    #[must_use]
    pub fn line(&self) -> serde_json::Value {
        let (kind, supersampling): (_, &[u32]) = match &self.task {
            Task::Exact => ("exact", &[]),
            Task::Method(variant) => ("method", &variant.supersampling),
            Task::External(_) => ("external", &[]),
        };
        let gpu = [("GPU", 1), ("TIMING", 1)].into_iter();
        let resources = gpu.filter(|_| self.is_timed_on_gpu()).collect();
        let line = Line {
            schema: JOB_SCHEMA,
            id: self.id.as_str(),
            order: self.order,
            kind,
            scene: &self.scene,
            method: &self.method,
            columns: &self.columns,
            width_px: self.resolution_px[0],
            height_px: self.resolution_px[1],
            positions: self.positions,
            supersampling,
            resources,
        };
        serde_json::to_value(&line).unwrap_or_default()
    }
}
