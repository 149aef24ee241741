//! The exact image of a cell of a scene: from the baseline while its hash is
//! unchanged, from the store, or traced.

use crate::Error;
use crate::gate::GateError;
use crate::gate::file::baseline::KeptTruth;
use crate::gate::file::half_image::HalfImage;
use crate::gate::file::scenes::{Estimator, SceneCell, SceneGate};
use crate::metric::Exposures;
use crate::study::cache::{Id, Store};
use crate::study::jobs::{Exact, Made};
use reference::{Paths, Positions};
use scenes::LayerName;

/// Branches of the tree below this weight are cut.
const CUT: f64 = 1e-4;
/// Paths per batch and position: with 16 batches at 4 x 4 positions 256 per pixel.
const PATHS: u32 = 1;
/// Seed of the images that the weights come from; the truth has seed 0.
const FROZEN_SEED: u64 = 1;

/// Name of the exact image that a cell is held against.
#[must_use]
pub fn name(cell: &SceneCell) -> String {
    match cell.exact {
        Estimator::Tree => cell.scene.name.clone(),
        Estimator::Paths => format!("{} (paths)", cell.scene.name),
    }
}

/// The hash of everything that it depends on.
#[must_use]
pub fn id(gate: &SceneGate, cell: &SceneCell) -> Id {
    job(gate, cell, 0).id()
}

/// Makes the exact image anew; with `frozen`, the image that the weights come from
/// too.
///
/// # Errors
/// If the scene cannot be traced, or the store cannot be used.
pub fn make(
    gate: &SceneGate,
    cell: &SceneCell,
    store: &Store,
    frozen: bool,
) -> Result<KeptTruth, Error> {
    let made = job(gate, cell, 0).make(store, &|_| ())?;
    let pinned = cell.scene.judgement.flip_exposures;
    let pinned =
        pinned.map(|(start, stop, count)| Exposures { start, stop, count: count as usize });
    let mean = layer(&made, &LayerName::Radiance, cell)?;
    let noisy = cell.exact == Estimator::Paths;
    let standard_error = if noisy {
        let variance = layer(&made, &LayerName::Variance, cell)?;
        Some(variance.iter().map(|v| v.max(0.0).sqrt()).collect::<Vec<_>>())
    } else {
        None
    };
    let frozen = if noisy && frozen {
        let other = job(gate, cell, FROZEN_SEED).make(store, &|_| ())?;
        Some(layer(&other, &LayerName::Radiance, cell)?)
    } else {
        None
    };
    let half = |values: Vec<f64>| {
        HalfImage::of(&values, gate.resolution_px).ok_or_else(|| GateError::Cell {
            cell: cell.name.clone(),
            reason: "the exact image holds NaN or infinity".to_owned(),
        })
    };
    Ok(KeptTruth {
        id: made.id.to_string(),
        // A black image: any exposures will do.
        exposures: pinned.or_else(|| Exposures::of(&mean)).or(Some(Exposures {
            start: 0.0,
            stop: 1.0,
            count: 2,
        })),
        mean: half(mean)?,
        standard_error: standard_error.map(half).transpose()?,
        frozen: frozen.map(half).transpose()?,
    })
}

fn job<'a>(gate: &SceneGate, cell: &'a SceneCell, seed: u64) -> Exact<'a> {
    let mut job = Exact::estimate(&cell.scene, gate.resolution_px, gate.positions, CUT);
    if cell.exact == Estimator::Paths {
        let paths = Paths { samples: PATHS, positions: Positions::Cells, seed, ..Paths::default() };
        job.request.estimator = reference::Estimator::Paths(paths);
        job.request.view.layers = vec![LayerName::Radiance, LayerName::Variance];
    }
    job
}

fn layer(made: &Made, name: &LayerName, cell: &SceneCell) -> Result<Vec<f64>, GateError> {
    let found = made.layers.get(name).filter(|layer| layer.channels == 3);
    found.map(|layer| layer.data.clone()).ok_or_else(|| GateError::Cell {
        cell: cell.name.clone(),
        reason: format!("the exact image has no layer {name}"),
    })
}
