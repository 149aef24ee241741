//! The image of now: a method rendered as the gate says.

use crate::Error;
use crate::gate::file::scenes::{SceneCell, SceneGate};
use crate::study::cache::Id;
use realtime::{Filter, Gpu, Keep, Request};
use scenes::{LayerName, View};
use serde::Serialize;
use std::collections::BTreeMap;

/// Counts that do not depend on how long anybody measured.
const WORK: [&str; 5] = ["bytes", "layer_bytes", "layers", "passes", "triangles"];

/// An image with what it took.
pub struct Head {
    /// Radiance, interleaved.
    pub radiance: Vec<f64>,
    /// Deterministic counts of work.
    pub work: BTreeMap<String, u64>,
}

/// Hash of what the image shows: the scene and the gate's settings, but not the
/// sources that render it. Where it differs, base shows something else.
#[must_use]
pub fn inputs(gate: &SceneGate, cell: &SceneCell) -> Id {
    #[derive(Serialize)]
    struct Description<'a> {
        scene: &'a str,
        method: &'a str,
        parameters: &'a BTreeMap<String, String>,
        resolution_px: [u32; 2],
        positions: u32,
    }
    Id::of(&Description {
        scene: &cell.scene.source.sha256,
        method: &cell.method,
        parameters: &cell.parameters,
        resolution_px: gate.resolution_px,
        positions: gate.positions,
    })
}

/// Renders a cell. `instead`: parameters that replace the gate's own.
///
/// # Errors
/// If the method cannot show the scene.
pub fn render(
    gate: &SceneGate,
    cell: &SceneCell,
    instead: &BTreeMap<String, String>,
    gpu: &Gpu,
) -> Result<Head, Error> {
    let mut parameters = cell.parameters.clone();
    parameters.extend(instead.clone());
    let request = Request {
        view: View {
            resolution_px: gate.resolution_px,
            positions_per_axis: gate.positions,
            frame: 0,
            layers: vec![LayerName::Radiance],
        },
        method: cell.method.clone(),
        parameters,
        filter: Filter::Manual,
        timing: None,
        keep: Keep::Needed,
    };
    let rendering = realtime::render(gpu, &cell.scene, &request)?;
    let radiance = rendering.layers.get(&LayerName::Radiance);
    let radiance = radiance.map(|layer| layer.data.clone()).unwrap_or_default();
    let counted = |(name, count): (String, u64)| WORK.contains(&&*name).then_some((name, count));
    Ok(Head { radiance, work: rendering.counters.into_iter().filter_map(counted).collect() })
}
