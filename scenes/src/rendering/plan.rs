//! What a renderer will do for a scene, and what it leaves out and why.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Work before it is done. Every renderer makes one, `snell plan` prints it,
/// and what was executed is recorded elsewhere so that the two can disagree.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Plan {
    /// Passes in execution order.
    pub passes: Vec<String>,
    /// Memory that will exist, by name.
    pub buffers: Vec<Buffer>,
    /// Most bytes that exist at the same time, with the layers that are handed
    /// over; 0 where nobody counts them.
    #[serde(default)]
    pub peak_bytes: u64,
    /// Variants chosen at compile time, such as `"one convex body"`.
    pub features: Vec<String>,
    /// What this scene does not need.
    pub left_out: Vec<LeftOut>,
    /// What this scene has and this method cannot show.
    pub unsupported: Vec<Unsupported>,
}

/// A piece of memory.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Buffer {
    /// Name, the same as its layer if it can be asked for as one.
    pub name: String,
    /// Size in bytes.
    pub bytes: u64,
}

/// Something that exists in the program and not in this run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct LeftOut {
    /// Name of what is missing.
    pub what: String,
    /// What it is.
    pub kind: Kind,
    /// Why this scene does not need it, in one sentence.
    pub reason: String,
    /// Bytes it would have taken.
    pub saves_bytes: u64,
}

/// What can be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A GPU pass or a stage of the tracer.
    Pass,
    /// Memory.
    Buffer,
    /// A binding of a shader.
    Binding,
    /// Code of a shader or a specialised function.
    Code,
    /// State carried along a ray.
    State,
    /// A metric.
    Metric,
}

/// A part of the scene that a method cannot show.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Unsupported {
    /// What the scene has.
    pub what: String,
    /// What the method does instead.
    pub instead: String,
}

impl Plan {
    /// Total memory in bytes.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.buffers.iter().map(|buffer| buffer.bytes).sum()
    }

    /// Notes that something is left out.
    pub fn leave_out(&mut self, kind: Kind, what: &str, reason: &str, saves_bytes: u64) {
        let (what, reason) = (what.to_owned(), reason.to_owned());
        self.left_out.push(LeftOut { what, kind, reason, saves_bytes });
    }
}
