//! What a study leaves behind: `results.jsonl`, one flat row per number, and
//! `study.json`, what belongs to a whole run (plans, images, provenance).
//!
//! Both carry a schema name; within a major version fields are only added.

mod columns;
pub mod curves;
mod store;

pub use columns::{Columns, FLIP_EXPOSURES, PARAM, SCENE, Scalar};
pub use store::{ResultsError, read_rows, read_study, write_rows, write_study};

use scenes::Plan;
use scenes::rendering::Pass;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Schema of a [`ResultRow`].
pub const RESULT_SCHEMA: &str = "snell.result/2";
/// Schema of a [`Study`].
pub const STUDY_SCHEMA: &str = "snell.study/1";
/// Name of the row file in a results directory.
pub const RESULTS_FILE: &str = "results.jsonl";
/// Name of the study file in a results directory.
pub const STUDY_FILE: &str = "study.json";
/// Layer name of a stored FLIP map.
pub const FLIP_LAYER: &str = "flip";
/// Method name of rows that describe the exact renderer itself.
pub const REFERENCE: &str = "reference";

/// What a row counts.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum RowKind {
    /// An error against the reference.
    #[default]
    Error,
    /// A duration, milliseconds: metric `time_timestamp_ms`, `time_wall_ms`
    /// or `time_cpu_ms`, the whole frame.
    Time,
    /// A deterministic count: passes, bytes, rays, flagged pixels.
    Count,
}

/// Which pixels are judged.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Mask {
    /// The whole image.
    #[default]
    All,
    /// Pixels that an object covers at least partly, by the reference's
    /// coverage layer: the same set for every method.
    Object,
}

/// Whether a value can be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Validity {
    /// The value is the metric.
    #[default]
    Ok,
    /// Both images are equal bit for bit; the value is known without computing
    /// it (0, or nothing where the metric would be infinite).
    Identical,
    /// The metric has no value for this pair, such as SSIM below 11 pixels.
    Undefined,
    /// An input holds NaN or infinity: no number is made of it.
    Invalid,
}

/// One number of a study: a row of `results.jsonl` and of `results.csv`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct ResultRow {
    /// [`RESULT_SCHEMA`].
    pub schema: String,
    /// What is counted.
    pub kind: RowKind,
    /// Content id of the job; rows of one image and its times share it.
    pub id: String,
    /// Name of the scene.
    pub scene: String,
    /// Method id, or [`REFERENCE`] for the exact renderer's own curve.
    pub method: String,
    /// Parameters of the method, defaults included, as `param.a`; numbers set in
    /// the scene as `scene.medium.glass.eta`; `flip_exposures.start`, `.stop` and
    /// `.count`. Each is a field of its own. The exact renderer's curve has
    /// `param.samples` and `param.cut`.
    #[serde(flatten)]
    pub columns: Columns,
    /// k: the number belongs to the mean over k x k positions in each pixel. A
    /// time is that of drawing them.
    pub positions: u32,
    /// Frame of the sequence.
    pub frame: u32,
    /// Width, pixels.
    pub width_px: u32,
    /// Height, pixels.
    pub height_px: u32,
    /// Seed of the random numbers, if any were drawn.
    pub seed: Option<u64>,
    /// Adapter or CPU that made the candidate.
    pub adapter: String,
    /// True when the adapter is a CPU in disguise.
    pub software: bool,
    /// Content id of the reference that was compared with.
    pub reference_id: String,
    /// Metric, with its constants in its name.
    pub metric: String,
    /// Unit: `""` for a ratio, `deg`, `dB`, `ms`, `B`, `radiance`.
    pub unit: String,
    /// Pixels that were judged.
    pub mask: Mask,
    /// The number; `null` where `status` says why there is none.
    pub value: Option<f64>,
    /// Lower end of the 95 % interval, where one is known.
    pub ci_lo: Option<f64>,
    /// Upper end of the 95 % interval.
    pub ci_hi: Option<f64>,
    /// What the interval is of: sub-lattices of pixels, frames, the variance of the
    /// reference; or why there is none.
    pub ci_of: String,
    /// Pixels, frames or samples behind the value.
    pub n: u64,
    /// Whether the value can be used.
    pub status: Validity,
    /// Why there is no value; empty when there is one.
    pub reason: String,
}

/// Everything about a study that is not a number per scene and method.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Study {
    /// [`STUDY_SCHEMA`].
    pub schema: String,
    /// Version of snell.
    pub version: String,
    /// When the study ended, RFC 3339, UTC.
    pub finished_utc: String,
    /// Command line that repeats it.
    pub command: String,
    /// GPU adapter.
    pub adapter: String,
    /// Driver name and version.
    pub driver: String,
    /// True when the adapter is a CPU in disguise.
    pub software: bool,
    /// Clock that the report plots: `time_wall_ms` on software adapters, else
    /// `time_timestamp_ms`.
    pub time_metric: String,
    /// Seconds the whole study took.
    pub elapsed_s: f64,
    /// Scenes in the order of the report.
    pub scenes: Vec<SceneEntry>,
    /// Exact and approximate images.
    pub runs: Vec<Run>,
    /// Scenes and methods that were asked for and not done, with the reason.
    pub left_out: Vec<NotDone>,
    /// Milliseconds within which the best method was asked for.
    pub budget_ms: Option<f64>,
    /// What the curves say in words, per scene.
    pub readings: Vec<Reading>,
}

/// One sentence that is read off the curves of error against time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Reading {
    /// Name of the [`SceneEntry`].
    pub scene: String,
    /// Method id, or empty for the scene as a whole.
    pub method: String,
    /// `equal-error`, `equal-time` or `budget`.
    pub kind: String,
    /// The sentence.
    pub text: String,
    /// The number that it states: milliseconds, or an error; `None` where the
    /// curves do not reach.
    pub value: Option<f64>,
}

impl Study {
    /// Method of a run, and the parameters in which runs of it at one place differ.
    #[must_use]
    pub fn name_of(&self, run: &Run) -> String {
        let same = |other: &&Run| other.scene == run.scene && other.method == run.method;
        let siblings: Vec<&Run> = self.runs.iter().filter(same).collect();
        let differs = |name: &str, value: &String| {
            siblings.iter().any(|other| other.parameters.get(name) != Some(value))
        };
        let own = run.parameters.iter().filter(|(name, value)| differs(name, value));
        let own = own.map(|(name, value)| format!(" {name}={value}"));
        std::iter::once(run.method.clone()).chain(own).collect()
    }
}

impl SceneEntry {
    /// Name of the scene, as in the rows.
    #[must_use]
    pub fn scene(&self) -> &str {
        if self.scene.is_empty() { &self.name } else { &self.scene }
    }

    /// True if a row belongs here.
    #[must_use]
    pub fn holds(&self, row: &ResultRow) -> bool {
        let own = |key: &str| self.set.get(key).map(|value| Scalar::Number(*value));
        let mut set = row.columns.under(SCENE);
        row.scene == self.scene()
            && [row.width_px, row.height_px] == self.resolution_px
            && row.columns.under(SCENE).count() == self.set.len()
            && set.all(|(key, value)| own(key).as_ref() == Some(value))
    }
}

/// One scene of a study, with its numbers at a resolution.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct SceneEntry {
    /// Name that no other entry has: the scene's, and what tells this place from
    /// others of the scene.
    pub name: String,
    /// Name of the scene, as in the rows; empty if it is `name`.
    pub scene: String,
    /// Numbers that are set in the scene.
    pub set: BTreeMap<String, f64>,
    /// Title from the scene file.
    pub title: String,
    /// Text of the scene file.
    pub toml: String,
    /// Width and height of the judged images, pixels.
    pub resolution_px: [u32; 2],
    /// What is doubtful in it.
    pub warnings: Vec<String>,
    /// Exposures of HDR-FLIP: start and stop (powers of two) and their number.
    pub flip_exposures: Option<(f64, f64, u32)>,
}

/// One image: by the exact renderer (`method` = [`REFERENCE`]) or a method.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Run {
    /// Content id, as in the rows.
    pub id: String,
    /// Name of the [`SceneEntry`].
    pub scene: String,
    /// Method id, [`REFERENCE`] or the name of somebody else's image.
    pub method: String,
    /// k of the k x k positions per pixel of its image.
    pub positions: u32,
    /// Parameters.
    pub parameters: BTreeMap<String, String>,
    /// EXR with all layers, relative to the results directory; empty where it was
    /// not kept, as for all but the best of a method's settings.
    pub image: PathBuf,
    /// EXR with the layer `flip` of this image against the reference, relative
    /// to the results directory; empty if the report is to compute it.
    pub flip_map: PathBuf,
    /// What was to run and what was left out.
    pub plan: Plan,
    /// What ran, recorded where it ran.
    pub passes: Vec<Pass>,
    /// Deterministic counts: rays, samples, texels, bytes, passes.
    pub counters: BTreeMap<String, u64>,
    /// Metrics that this pair does not have, with the reason.
    pub metrics_left_out: Vec<NotDone>,
}

/// Something that was not done.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct NotDone {
    /// What: a scene, `scene × method`, a metric.
    pub what: String,
    /// Why, in one sentence.
    pub reason: String,
}

/// Name of a time's row in a frame with everything in it that the scene does
/// not need.
#[must_use]
pub fn with_all_kept(time_metric: &str) -> String {
    format!("{}_all_kept_ms", time_metric.trim_end_matches("_ms"))
}

/// Milliseconds of a frame that leaving out saves, if both were measured. Two
/// frames are timed, so noise can make it negative.
pub fn saved_ms<'a>(
    rows: impl Iterator<Item = &'a ResultRow> + Clone,
    time_metric: &str,
) -> Option<f64> {
    let value = |metric: &str| rows.clone().find(|row| row.metric == metric)?.value;
    Some(value(&with_all_kept(time_metric))? - value(time_metric)?)
}
