//! What the frames of a request did, and how long they took.

use super::counted::Counted;
use crate::gpu::recorder::Executed;
use scenes::rendering::{Pass, Time, TimeSource};

/// Finding the distances along the normals, on the CPU.
pub(crate) const THICKNESS: &str = "distances along normals";
/// Fitting the boxes that rays search to where things have moved, on the CPU.
pub(crate) const REFIT: &str = "boxes refitted";
/// Name of the entry with the wall time of a frame.
const WHOLE_FRAME: &str = "frame";

/// What all frames of a request did, as the recorder and the allocator saw it.
#[derive(Default)]
pub(crate) struct FrameTimes {
    pub(crate) passes: Vec<Pass>,
    pub(crate) count: u64,
    pub(crate) bytes: u64,
    pub(crate) timed_frames: u64,
    pub(crate) layers: u64,
    pub(crate) layer_bytes: u64,
}

impl FrameTimes {
    /// Layers per pixel that are kept, and their bytes, in the frame that keeps
    /// the most.
    pub(crate) fn layers(&mut self, counted: Counted) {
        self.layers = self.layers.max(u64::from(counted.capacity));
        self.layer_bytes = self.layer_bytes.max(counted.bytes());
    }

    /// `on_cpu`: what the CPU did before the frame, and would before every other.
    pub(crate) fn add(
        &mut self,
        label: &str,
        executed: &[String],
        timed: &[Executed],
        on_cpu: &[(&str, Option<f64>)],
    ) {
        self.count += executed.len() as u64;
        self.timed_frames += timed.len() as u64;
        let mut cpu_ms = 0.0;
        for (name, milliseconds) in on_cpu {
            let Some(milliseconds) = *milliseconds else { continue };
            self.count += 1;
            cpu_ms += milliseconds;
            let times = vec![Time::once(TimeSource::Cpu, milliseconds)];
            self.passes.push(Pass { name: format!("{label}{name}"), times });
        }
        let passes = executed.iter().enumerate();
        self.passes.extend(passes.map(|(index, name)| Pass {
            name: format!("{label}{name}"),
            times: timestamp(timed, index),
        }));
        if !timed.is_empty() {
            let frames_ms = timed.iter().map(|frame| frame.wall_ms + cpu_ms).collect();
            let times = vec![measured(TimeSource::Wall, frames_ms)];
            self.passes.push(Pass { name: format!("{label}{WHOLE_FRAME}"), times });
        }
    }
}

fn timestamp(frames: &[Executed], pass: usize) -> Vec<Time> {
    let values: Vec<f64> =
        frames.iter().filter_map(|frame| frame.timestamp_ms.as_ref()?.get(pass).copied()).collect();
    if values.is_empty() {
        return Vec::new();
    }
    vec![measured(TimeSource::Timestamp, values)]
}

fn measured(source: TimeSource, frames_ms: Vec<f64>) -> Time {
    Time { source, milliseconds: median(&frames_ms), frames_ms }
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) }
}
