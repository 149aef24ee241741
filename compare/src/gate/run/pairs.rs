//! Checking a gate over image files.

use super::{Checked, conclude, known, margins, wanted};
use crate::Error;
use crate::gate::GateError;
use crate::gate::cell::judge::{Material, Raised};
use crate::gate::file::baseline::{Baseline, KeptTruth};
use crate::gate::file::half_image::HalfImage;
use crate::gate::file::pairs::{PairCell, PairGate};
use crate::gate::limit;
use crate::gate::verdict::{Check, Outcome};
use crate::image_pair::ImagePairError;
use crate::metric::{
    Candidate, Encoding, Exposures, JudgementError, Mask, Reference, Selection, judge,
};
use crate::study::cache::Id;
use scenes::LayerName;
use scenes::image::{Alpha, Picture};
use std::path::Path;

/// Holds every pair to its limits and, where there is a baseline, to it.
///
/// # Errors
/// If a reference or a mask cannot be used, sizes differ, or a limit is of a
/// metric that a pair does not have.
pub fn check_pairs(gate: &PairGate, only: &[String]) -> Result<Checked, Error> {
    let names: Vec<&str> = gate.pairs.iter().map(|pair| pair.name.as_str()).collect();
    known(only, &names)?;
    let baseline = gate.baseline.exists().then(|| Baseline::read(&gate.baseline)).transpose()?;
    let mut checked = Checked {
        gate: gate.path.clone(),
        again: Vec::new(),
        of_pairs: true,
        adapter: None,
        device: "files".to_owned(),
        checks: Vec::new(),
        judged: Vec::new(),
        left_out: Vec::new(),
        notes: Vec::new(),
        material: Vec::new(),
    };
    let accept = format!("snell baseline accept --pairs {}", gate.path.display());
    if baseline.is_none() {
        let unlimited = gate.pairs.iter().find(|pair| pair.limits.is_empty());
        if unlimited.is_some() {
            // Without limits and without a baseline nothing would be checked.
            return Err(GateError::NoBaseline { path: gate.baseline.clone(), accept }.into());
        }
        checked.notes.push(format!("there is no baseline, only limits are held; {accept}"));
    }
    let mut raised = Vec::new();
    for pair in &gate.pairs {
        if !wanted(&pair.name, only) {
            checked.left_out.push(format!("{}: not asked for by --only", pair.name));
            continue;
        }
        checked.judged.push(pair.name.clone());
        if !exists(&pair.test) {
            let reason = format!("{} is missing", pair.test.display());
            raised.push(Raised::failure(&pair.name, "image", reason));
            continue;
        }
        let loaded = Loaded::read(gate, pair)?;
        checked.notes.extend(loaded.warnings(pair));
        let limits = loaded.limits(pair)?;
        raised.push(Raised { checks: limits, ..Raised::default() });
        match loaded.beside(baseline.as_ref(), pair, &mut checked.notes) {
            Some(Ok(material)) => {
                raised.push(material.raise(&margins(&gate.margins, None)));
                checked.material.push(material);
            }
            Some(Err(failure)) => raised.push(failure),
            None => {}
        }
    }
    checked.checks = conclude(raised, gate.rule, &gate.expected, None, &checked.judged);
    Ok(checked)
}

/// A pair as it was read.
pub(super) struct Loaded {
    reference: Picture,
    test: Picture,
    mask: Mask,
    /// The reference at the gate's resolution.
    pub(super) truth: KeptTruth,
    /// The test at the gate's resolution, unless it holds NaN or infinity.
    pub(super) head: Option<HalfImage>,
    /// Hash of what base and head must share.
    pub(super) inputs: String,
}

impl Loaded {
    pub(super) fn read(gate: &PairGate, pair: &PairCell) -> Result<Self, Error> {
        let (mut reference, test) = (picture(&pair.reference)?, picture(&pair.test)?);
        let paths = || (pair.reference.clone(), pair.test.clone());
        let is_linear = reference.encoding == Encoding::Linear;
        if reference.encoding != test.encoding {
            let (reference, test) = paths();
            let (linear, display) = match is_linear {
                true => (reference, test),
                false => (test, reference),
            };
            return Err(ImagePairError::Encoding { linear, display }.into());
        }
        let [r, t] = [&reference, &test].map(|image| image.layers.resolution_px);
        if r != t {
            let (reference, candidate) = paths();
            let source = JudgementError::Size { reference: r, candidate: t };
            return Err(ImagePairError::Judgement { reference, candidate, source }.into());
        }
        let mask = pair.mask.as_deref().map(|path| mask(path, r)).transpose()?;
        let [whole, tested] =
            [(&reference, &pair.reference), (&test, &pair.test)].map(|(image, path)| {
                let found = image.layers.get(&LayerName::Radiance).filter(|l| l.channels == 3);
                found.map(|layer| layer.data.clone()).ok_or_else(|| Error::Image {
                    path: path.clone(),
                    why: "it has no colours".to_owned(),
                })
            });
        let (whole, mut tested) = (whole?, tested?);
        if let Some(mask) = &mask {
            // Outside the mask both sides count as equal.
            for (i, value) in tested.iter_mut().enumerate().filter(|(i, _)| mask[i / 3] == 0.0) {
                *value = whole[i];
            }
            reference.layers.push(LayerName::Coverage, 1, mask.clone());
        }
        let (small, size_px) = shrunk(&whole, r, gate.gate_px);
        let mean = HalfImage::of(&small, size_px).ok_or_else(|| Error::Image {
            path: pair.reference.clone(),
            why: "a reference that holds NaN or infinity cannot be taken as true".to_owned(),
        })?;
        let exposures = if is_linear {
            let chosen = Exposures::of(&small);
            // A black reference: any exposures will do.
            Some(chosen.unwrap_or(Exposures { start: 0.0, stop: 1.0, count: 2 }))
        } else {
            None
        };
        let truth = KeptTruth {
            id: Id::of(&(mean.stops, mean.pack())).to_string(),
            mean,
            standard_error: None,
            frozen: None,
            exposures,
        };
        let head = HalfImage::of(&shrunk(&tested, r, gate.gate_px).0, size_px);
        let masked = mask.as_ref().map(|m| m.iter().map(|v| *v as u8).collect::<Vec<_>>());
        let inputs = Id::of(&(r, gate.gate_px, is_linear, masked)).to_string();
        let mask = if mask.is_some() { Mask::Object } else { Mask::All };
        Ok(Self { reference, test, mask, truth, head, inputs })
    }

    /// What the files say of their pixels and is not obeyed.
    fn warnings(&self, pair: &PairCell) -> Vec<String> {
        let sides = [(&self.reference, &pair.reference), (&self.test, &pair.test)];
        let told = |(image, path): (&Picture, &std::path::PathBuf)| {
            let path = path.display().to_string();
            image.warnings.iter().map(move |text| format!("{path}: {text}")).collect::<Vec<_>>()
        };
        sides.into_iter().flat_map(told).collect()
    }

    /// The pair at its own resolution held to its limits, and to being finite.
    fn limits(&self, pair: &PairCell) -> Result<Vec<Check>, Error> {
        if self.head.is_none() {
            let reason = "the image holds NaN or infinity".to_owned();
            return Ok(vec![Check::plain(&pair.name, "image", Outcome::Fail, reason)]);
        }
        if pair.limits.is_empty() {
            return Ok(Vec::new());
        }
        let mut selection = Selection::all(self.reference.encoding);
        selection.masks = vec![self.mask];
        let found =
            judge(Reference(&self.reference.layers), Candidate(&self.test.layers), &selection)?;
        limit::check(&pair.name, &found.measurements, self.mask, &pair.limits).map_err(Error::Usage)
    }

    /// The pair beside what was accepted, or why it fails without.
    fn beside(
        self,
        baseline: Option<&Baseline>,
        pair: &PairCell,
        notes: &mut Vec<String>,
    ) -> Option<Result<Material, Raised>> {
        let baseline = baseline?;
        let failure =
            |reason: &str| Some(Err(Raised::failure(&pair.name, "baseline", reason.to_owned())));
        let head = self.head?;
        let Some(base) = baseline.cells.get(&pair.name) else {
            return failure("the baseline does not have it: accept it");
        };
        if base.inputs != self.inputs {
            return failure("its size or its mask is not that of the baseline");
        }
        let mut truth = self.truth;
        if let Some(kept) = baseline.truths.get(&base.truth).filter(|kept| kept.id != truth.id) {
            notes.push(format!("{}: the reference is not that of the baseline", pair.name));
            truth.frozen = Some(kept.mean.clone());
            truth.exposures = kept.exposures;
        }
        let (name, work) = (pair.name.clone(), Default::default());
        Some(Ok(Material { name, truth, base: base.clone(), head: vec![head], work }))
    }
}

/// An image file, or a layer of one.
fn picture(path: &Path) -> Result<Picture, Error> {
    Ok(scenes::image::open(path, Alpha::default())?)
}

/// True for a file, or for a layer FILE:LAYER of a file.
fn exists(path: &Path) -> bool {
    let text = path.to_string_lossy();
    path.exists() || text.rsplit_once(':').is_some_and(|(file, _)| Path::new(file).exists())
}

/// 1 where the mask is brighter than a half, else 0, per pixel.
fn mask(path: &Path, size_px: [u32; 2]) -> Result<Vec<f64>, Error> {
    let fail = |why: String| Error::Image { path: path.to_owned(), why };
    let layers = picture(path)?.layers;
    if layers.resolution_px != size_px {
        let [[w, h], [x, y]] = [layers.resolution_px, size_px];
        return Err(fail(format!("the mask is {w} x {h} pixels, the images {x} x {y}")));
    }
    let layer = layers.get(&LayerName::Radiance).or(layers.list.first());
    let layer = layer.ok_or_else(|| fail("the mask has no channel".to_owned()))?;
    let pixel = |channels: &[f64]| {
        let bright = channels.iter().sum::<f64>() / channels.len() as f64 > 0.5;
        f64::from(u8::from(bright))
    };
    let mask: Vec<f64> = layer.data.chunks_exact(layer.channels).map(pixel).collect();
    match mask.contains(&1.0) {
        true => Ok(mask),
        false => Err(fail("no pixel of the mask is brighter than a half".to_owned())),
    }
}

/// Means over blocks of a whole number of pixels, so that no side is longer than
/// `most_px`; blocks at the right and lower edge may be smaller.
fn shrunk(values: &[f64], [width, height]: [u32; 2], most_px: u32) -> (Vec<f64>, [u32; 2]) {
    let factor = width.max(height).div_ceil(most_px);
    let small = [width.div_ceil(factor), height.div_ceil(factor)];
    let mut mean = Vec::with_capacity(3 * small[0] as usize * small[1] as usize);
    for y in 0..small[1] {
        for x in 0..small[0] {
            let rows = y * factor..((y + 1) * factor).min(height);
            let columns = x * factor..((x + 1) * factor).min(width);
            let count = f64::from((rows.end - rows.start) * (columns.end - columns.start));
            let mut sum = [0.0; 3];
            for place in rows.flat_map(|row| columns.clone().map(move |c| row * width + c)) {
                for (c, sum) in sum.iter_mut().enumerate() {
                    *sum += values[3 * place as usize + c];
                }
            }
            mean.extend(sum.map(|sum| sum / count));
        }
    }
    (mean, small)
}
