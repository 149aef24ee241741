//! One piece of a study, named by a hash of everything that it is asked.

use super::Variant;
use crate::results::{Columns, Scalar};
use crate::study::cache::Id;
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
pub(super) struct Asked<'a> {
    pub(super) version: &'a str,
    pub(super) sources: [&'a str; 2],
    pub(super) name: &'a str,
    /// Hash of the scene's text and files, before numbers are set in it.
    pub(super) scene: &'a str,
    pub(super) set: &'a BTreeMap<String, f64>,
    pub(super) resolution_px: [u32; 2],
    pub(super) positions: u32,
    pub(super) cut: f64,
    pub(super) timing_s: f64,
    pub(super) thorough: bool,
    pub(super) method: &'a str,
    /// Of a method from a user's file, or hash of an external image.
    pub(super) text: Option<&'a str>,
    pub(super) param: &'a BTreeMap<String, Scalar>,
    pub(super) supersampling: &'a [u32],
    pub(super) milliseconds: Option<f64>,
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
