//! How a renderer is asked for an image and how it answers.
//!
//! Each renderer has `render(&Scene, &Request) -> Result<Rendering, Error>`;
//! its `Request` holds a [`View`] and what only that renderer needs.

pub mod layer;
pub mod plan;

use crate::{LayerName, Layers, Plan};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What both renderers are asked alike.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Width and height, pixels. Replaces the scene's own.
    pub resolution_px: [u32; 2],
    /// k: radiance is the mean over k x k positions per pixel, at
    /// ((i + ½)/k, (j + ½)/k). Exit layers always use the pixel centre.
    pub positions_per_axis: u32,
    /// Frame of the sequence; 0 is the still.
    pub frame: u32,
    /// Layers to compute. What is not asked for is not computed.
    pub layers: Vec<LayerName>,
}

impl View {
    /// True if the layer was asked for.
    #[must_use]
    pub fn wants(&self, name: &LayerName) -> bool {
        self.layers.contains(name)
    }
}

/// A rendered image and everything needed to judge and repeat it.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// Exactly the layers that were asked for.
    pub layers: Layers,
    /// What ran, in order, with its times.
    pub passes: Vec<Pass>,
    /// Deterministic counts of work: rays, samples, texels, bytes, passes.
    pub counters: BTreeMap<String, u64>,
    /// What was to run and what was left out.
    pub plan: Plan,
    /// By whom, where and from what.
    pub provenance: Provenance,
}

/// One executed pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Pass {
    /// Name, as in the plan.
    pub name: String,
    /// Milliseconds by source; empty when nothing was timed.
    pub times: Vec<Time>,
}

/// A duration and who measured it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Time {
    /// Who measured.
    pub source: TimeSource,
    /// Milliseconds (median where several were taken).
    pub milliseconds: f64,
    /// Milliseconds of each frame, in the order in which they were drawn; empty where it
    /// was measured once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames_ms: Vec<f64>,
}

impl Time {
    /// Measured once.
    #[must_use]
    pub fn once(source: TimeSource, milliseconds: f64) -> Self {
        Self { source, milliseconds, frames_ms: Vec::new() }
    }
}

/// Clocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TimeSource {
    /// GPU timestamp queries.
    Timestamp,
    /// Wall clock from submission to completion, or around CPU work.
    Wall,
    /// CPU time, user and system, of all threads.
    Cpu,
}

/// Where a rendering comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Provenance {
    /// `reference` or a method id.
    pub renderer: String,
    /// Parameters as `name = value`, defaults included.
    pub parameters: BTreeMap<String, String>,
    /// Name of the GPU adapter, or of the CPU.
    pub adapter: String,
    /// Driver name and version; empty for the CPU.
    pub driver: String,
    /// True when the adapter is a CPU in disguise.
    pub software: bool,
    /// Seed of the random numbers, if any were drawn.
    pub seed: Option<u64>,
    /// Version of snell.
    pub version: String,
}
