//! Accepting: what is now becomes the baseline.

use super::pairs::Loaded;
use super::{known, wanted};
use crate::Error;
use crate::gate::cell::{head, truth};
use crate::gate::file::baseline::{Baseline, KeptCell};
use crate::gate::file::half_image::HalfImage;
use crate::gate::file::pairs::PairGate;
use crate::gate::file::scenes::SceneGate;
use crate::gate::{AdapterClass, GateError};
use crate::study::cache::Store;
use realtime::Gpu;
use std::path::PathBuf;

/// A baseline that was written.
pub struct Accepted {
    /// Where.
    pub path: PathBuf,
    /// Its size.
    pub bytes: usize,
    /// Names of the cells that were accepted now.
    pub cells: Vec<String>,
    /// How many cells it has in all.
    pub total: usize,
}

/// Renders the cells, all or those whose names start with one of `only`, and
/// writes the baseline; others stay as they are.
///
/// # Errors
/// If a cell cannot be rendered, holds NaN or infinity, or the file cannot be
/// written. Then nothing is accepted.
pub fn accept_scenes(
    gate: &SceneGate,
    only: &[String],
    gpu: &Gpu,
    store: &Store,
    now: &dyn Fn(&str),
) -> Result<Accepted, Error> {
    let names: Vec<&str> = gate.cells.iter().map(|cell| cell.name.as_str()).collect();
    known(only, &names)?;
    let mut baseline = before(&gate.baseline, only)?;
    let mut cells = Vec::new();
    for cell in gate.cells.iter().filter(|cell| wanted(&cell.name, only)) {
        now(&cell.name);
        let name = truth::name(cell);
        let id = truth::id(gate, cell);
        if baseline.truths.get(&name).is_none_or(|kept| kept.id != id.as_str()) {
            baseline.truths.insert(name.clone(), truth::make(gate, cell, store, true)?);
        }
        let made = head::render(gate, cell, &Default::default(), gpu)?;
        let image = HalfImage::of(&made.radiance, gate.resolution_px).ok_or_else(|| {
            let reason = "its image holds NaN or infinity and cannot be accepted".to_owned();
            GateError::Cell { cell: cell.name.clone(), reason }
        })?;
        let kept = KeptCell {
            numbers: baseline.truths[&name].numbers(&image),
            truth: name,
            inputs: head::inputs(gate, cell).to_string(),
            adapter: Some(AdapterClass::of(gpu.info())),
            device: format!("{}, {}", gpu.info().name, gpu.info().driver),
            images: vec![image],
            work: made.work,
        };
        baseline.cells.insert(cell.name.clone(), kept);
        cells.push(cell.name.clone());
    }
    finish(baseline, &names, gate.baseline.clone(), cells)
}

/// Reads the pairs and writes the baseline.
///
/// # Errors
/// As [`accept_scenes`], of files.
pub fn accept_pairs(gate: &PairGate, only: &[String]) -> Result<Accepted, Error> {
    let names: Vec<&str> = gate.pairs.iter().map(|pair| pair.name.as_str()).collect();
    known(only, &names)?;
    let mut baseline = before(&gate.baseline, only)?;
    let mut cells = Vec::new();
    for pair in gate.pairs.iter().filter(|pair| wanted(&pair.name, only)) {
        let loaded = Loaded::read(gate, pair)?;
        let image = loaded.head.clone().ok_or_else(|| {
            let reason = "its image holds NaN or infinity and cannot be accepted".to_owned();
            GateError::Cell { cell: pair.name.clone(), reason }
        })?;
        let kept = KeptCell {
            numbers: loaded.truth.numbers(&image),
            truth: pair.name.clone(),
            inputs: loaded.inputs.clone(),
            adapter: None,
            device: String::new(),
            images: vec![image],
            work: Default::default(),
        };
        baseline.truths.insert(pair.name.clone(), loaded.truth);
        baseline.cells.insert(pair.name.clone(), kept);
        cells.push(pair.name.clone());
    }
    finish(baseline, &names, gate.baseline.clone(), cells)
}

/// The baseline that some cells are replaced in, or an empty one.
fn before(path: &std::path::Path, only: &[String]) -> Result<Baseline, GateError> {
    match path.exists() && !only.is_empty() {
        true => Baseline::read(path),
        false => Ok(Baseline::default()),
    }
}

/// Drops what the gate no longer watches, and writes.
fn finish(
    mut baseline: Baseline,
    names: &[&str],
    path: PathBuf,
    cells: Vec<String>,
) -> Result<Accepted, Error> {
    baseline.cells.retain(|name, _| names.contains(&name.as_str()));
    let used: Vec<String> = baseline.cells.values().map(|cell| cell.truth.clone()).collect();
    baseline.truths.retain(|name, _| used.contains(name));
    let bytes = baseline.write(&path)?;
    Ok(Accepted { path, bytes, cells, total: baseline.cells.len() })
}
