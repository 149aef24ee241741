//! Checking a gate over scenes.

use super::{Checked, conclude, known, margins, wanted};
use crate::Error;
use crate::gate::cell::judge::{Material, Raised};
use crate::gate::cell::{head, truth};
use crate::gate::file::baseline::{Baseline, KeptCell, KeptTruth};
use crate::gate::file::half_image::HalfImage;
use crate::gate::file::scenes::{SceneCell, SceneGate};
use crate::gate::{AdapterClass, GateError};
use crate::study::cache::Store;
use realtime::Gpu;
use std::collections::BTreeMap;

/// What a check over scenes looks at.
#[derive(Clone, Debug, Default)]
pub struct SceneOptions {
    /// Only cells that the gate marks as quick.
    pub quick: bool,
    /// Only cells whose names start so; all if empty.
    pub only: Vec<String>,
    /// Parameters of head that replace the gate's own, by method: to see whether
    /// the gate notices.
    pub instead: BTreeMap<String, BTreeMap<String, String>>,
}

impl SceneOptions {
    /// The arguments that say the same.
    fn again(&self) -> Vec<String> {
        let of = |(method, list): (&String, &BTreeMap<String, String>)| {
            let one = |(name, value): (&String, &String)| format!("{method}.{name}={value}");
            list.iter().map(one).collect::<Vec<_>>()
        };
        let written = self.instead.iter().flat_map(of);
        written.flat_map(|value| ["--head-param".to_owned(), value]).collect()
    }
}

/// Renders every cell and holds it to the baseline.
///
/// # Errors
/// If there is no baseline, or an exact image cannot be made.
pub fn check_scenes(
    gate: &SceneGate,
    options: &SceneOptions,
    gpu: &Gpu,
    store: &Store,
    now: &dyn Fn(&str),
) -> Result<Checked, Error> {
    let names: Vec<&str> = gate.cells.iter().map(|cell| cell.name.as_str()).collect();
    known(&options.only, &names)?;
    let accept = format!("snell baseline accept {}", gate.path.display());
    if !gate.baseline.exists() {
        return Err(GateError::NoBaseline { path: gate.baseline.clone(), accept }.into());
    }
    let baseline = Baseline::read(&gate.baseline)?;
    let class = AdapterClass::of(gpu.info());
    let mut checked = Checked {
        gate: gate.path.clone(),
        again: options.again(),
        of_pairs: false,
        adapter: Some(class),
        device: gpu.info().name.clone(),
        checks: Vec::new(),
        judged: Vec::new(),
        left_out: Vec::new(),
        notes: Vec::new(),
        material: Vec::new(),
    };
    let margins = margins(&gate.margins, Some(class));
    let mut truths = Truths { gate, store, baseline: &baseline, made: BTreeMap::new() };
    let mut raised = Vec::new();
    for cell in &gate.cells {
        if !wanted(&cell.name, &options.only) {
            checked.left_out.push(format!("{}: not asked for by --only", cell.name));
            continue;
        }
        if options.quick && !cell.quick {
            checked.left_out.push(format!("{}: the gate has quick = false for it", cell.name));
            continue;
        }
        now(&cell.name);
        checked.judged.push(cell.name.clone());
        match material(cell, &mut truths, options, gpu, &mut checked.notes)? {
            Ok(material) => {
                raised.push(material.raise(&margins));
                checked.material.push(material);
            }
            Err(failure) => raised.push(failure),
        }
    }
    lost(&baseline, &names, options, &mut checked.left_out, &mut raised);
    checked.checks = conclude(raised, gate.rule, &gate.expected, checked.adapter, &checked.judged);
    Ok(checked)
}

/// A cell that was accepted and is no longer watched must not go unnoticed.
fn lost(
    baseline: &Baseline,
    names: &[&str],
    options: &SceneOptions,
    left_out: &mut Vec<String>,
    raised: &mut Vec<Raised>,
) {
    for name in baseline.cells.keys().filter(|name| !names.contains(&name.as_str())) {
        if options.only.is_empty() {
            let reason = "the baseline has it, but the gate no longer watches it".to_owned();
            raised.push(Raised::failure(name, "cell", reason));
        } else {
            left_out.push(format!("{name}: not asked for by --only"));
        }
    }
}

/// The images of a cell, or why it fails without any.
fn material(
    cell: &SceneCell,
    truths: &mut Truths,
    options: &SceneOptions,
    gpu: &Gpu,
    notes: &mut Vec<String>,
) -> Result<Result<Material, Raised>, Error> {
    let failure = |what: &str, reason: String| Ok(Err(Raised::failure(&cell.name, what, reason)));
    let Some(base) = truths.baseline.cells.get(&cell.name) else {
        return failure("baseline", "the baseline does not have it: accept it".to_owned());
    };
    if base.inputs != head::inputs(truths.gate, cell).as_str() {
        let reason = "its scene or the gate's settings are others than when it was accepted";
        return failure("baseline", reason.to_owned());
    }
    let none = BTreeMap::new();
    let instead = options.instead.get(&cell.method).unwrap_or(&none);
    let head = match head::render(truths.gate, cell, instead, gpu) {
        Ok(head) => head,
        Err(Error::Realtime(reason)) => return failure("image", reason.to_string()),
        Err(error) => return Err(error),
    };
    let broken = head.radiance.iter().filter(|value| !value.is_finite()).count();
    let Some(image) = HalfImage::of(&head.radiance, truths.gate.resolution_px) else {
        let values = head.radiance.len();
        return failure("image", format!("{broken} of {values} values are NaN or infinite"));
    };
    let truth = truths.of(cell, notes)?;
    let base: KeptCell = base.clone();
    Ok(Ok(Material { name: cell.name.clone(), truth, base, head: vec![image], work: head.work }))
}

/// Exact images, each looked up or made once.
struct Truths<'a> {
    gate: &'a SceneGate,
    store: &'a Store,
    baseline: &'a Baseline,
    made: BTreeMap<String, KeptTruth>,
}

impl Truths<'_> {
    fn of(&mut self, cell: &SceneCell, notes: &mut Vec<String>) -> Result<KeptTruth, Error> {
        let name = truth::name(cell);
        let kept = self.baseline.truths.get(&name);
        if let Some(kept) = kept.filter(|kept| kept.id == truth::id(self.gate, cell).as_str()) {
            return Ok(kept.clone());
        }
        if let Some(made) = self.made.get(&name) {
            return Ok(made.clone());
        }
        let mut made = truth::make(self.gate, cell, self.store, kept.is_none())?;
        // The weights, and how FLIP looks, stay those of the baseline.
        if let Some(kept) = kept {
            made.frozen = Some(kept.frozen.clone().unwrap_or_else(|| kept.mean.clone()));
            made.exposures = kept.exposures;
        }
        let same = kept.is_some_and(|kept| kept.mean == made.mean);
        let what = if same { "the same image" } else { "ANOTHER image than in the baseline" };
        notes.push(format!(
            "{name}: the exact renderer or the scene is not that of the baseline; rendered again: {what}"
        ));
        self.made.insert(name, made.clone());
        Ok(made)
    }
}
