//! The questions that a cell raises, and what is known of it without asking.

use crate::gate::difference::{
    Eye, Truth, corrected_relmse, mean_flip, of_bias, of_flip, of_relmse,
};
use crate::gate::file::baseline::{KeptCell, KeptTruth};
use crate::gate::file::half_image::HalfImage;
use crate::gate::file::margin::{Gated, Margins};
use crate::gate::verdict::{Check, Outcome, Question};
use crate::metric::{Candidate, Encoding, Mask, Reference, Selection, error, judge as measure_all};
use crate::support::statistics::Estimate;
use scenes::{LayerName, Layers};
use std::collections::BTreeMap;

/// A cell with all its images.
pub struct Material {
    /// Name of the cell.
    pub name: String,
    /// The exact image.
    pub truth: KeptTruth,
    /// What was accepted.
    pub base: KeptCell,
    /// The images of now, rounded as those of base are.
    pub head: Vec<HalfImage>,
    /// Work of now.
    pub work: BTreeMap<String, u64>,
}

/// What a cell comes to before all cells are judged together.
#[derive(Default)]
pub struct Raised {
    /// What statistics answer.
    pub questions: Vec<Question>,
    /// What is plain already.
    pub checks: Vec<Check>,
}

impl Raised {
    /// A cell that cannot be judged fails.
    #[must_use]
    pub fn failure(cell: &str, what: &str, reason: String) -> Self {
        let check = Check::plain(cell, what, Outcome::Fail, reason);
        Self { checks: vec![check], ..Self::default() }
    }
}

impl Material {
    /// Every question about the cell.
    #[must_use]
    pub fn raise(&self, margins: &Margins) -> Raised {
        let of = |images: &[HalfImage]| images.iter().map(HalfImage::values).collect::<Vec<_>>();
        let (head, base) = (of(&self.head), of(&self.base.images));
        let head: Vec<&[f64]> = head.iter().map(Vec::as_slice).collect();
        let base: Vec<&[f64]> = base.iter().map(Vec::as_slice).collect();
        self.truth.with(|truth| {
            let mut raised = Raised::default();
            self.images(truth, &head, &base, margins, &mut raised);
            self.work(margins, &mut raised);
            raised
        })
    }

    fn images(
        &self,
        truth: &Truth,
        head: &[&[f64]],
        base: &[&[f64]],
        margins: &Margins,
        raised: &mut Raised,
    ) {
        let size_px = self.truth.mean.size_px.map(|side| side as usize);
        let (Some(first), Some(relmse), Some(bias)) =
            (base.first(), of_relmse(truth, head, base), of_bias(truth, head, base))
        else {
            let reason = "an image is missing on one side".to_owned();
            raised.checks.push(Check::plain(&self.name, "image", Outcome::Fail, reason));
            return;
        };
        let brightness = error::mae(truth.mean, &vec![0.0; truth.mean.len()]);
        let of_base = corrected_relmse(truth, first);
        self.ask(Gated::RelMse, of_base, relmse, margins.allow(Gated::RelMse, of_base), raised);
        let bias_of_base = error::bias(truth.mean, first).abs();
        self.ask(Gated::Bias, bias_of_base, bias, margins.allow(Gated::Bias, brightness), raised);
        let eye = self.truth.exposures.map_or(Eye::Display, Eye::Linear);
        let flip = mean_flip(truth.mean, first, size_px, eye)
            .and_then(|flip| Ok((flip, of_flip(truth, head, base, size_px, eye)?)));
        match flip {
            Ok((of_base, Some(flip))) => {
                self.ask(Gated::Flip, of_base, flip, margins.allow(Gated::Flip, of_base), raised);
            }
            Ok((_, None)) => {}
            Err(reason) => {
                raised.checks.push(Check::plain(&self.name, "flip", Outcome::Fail, reason));
            }
        }
    }

    fn ask(&self, gated: Gated, base: f64, difference: Estimate, margin: f64, raised: &mut Raised) {
        let (cell, metric) = (self.name.clone(), gated.name().to_owned());
        let head = base + difference.value;
        raised.questions.push(Question { cell, metric, base, head, difference, margin });
    }

    /// Counts have no scatter: more than the margin is more.
    fn work(&self, margins: &Margins, raised: &mut Raised) {
        for (name, &base) in &self.base.work {
            let Some(&head) = self.work.get(name) else {
                let reason = "it is no longer counted".to_owned();
                raised.checks.push(Check::plain(&self.name, name, Outcome::Fail, reason));
                continue;
            };
            let (base, head) = (base as f64, head as f64);
            let margin = margins.allow(Gated::Work, base);
            let more = head - base > margin;
            let outcome = if more { Outcome::Fail } else { Outcome::Pass };
            let reason = if more { "more work than allowed" } else { "" }.to_owned();
            raised.checks.push(Check {
                base: Some(base),
                head: Some(head),
                difference: Some(head - base),
                margin: Some(margin),
                ..Check::plain(&self.name, &format!("work_{name}"), outcome, reason)
            });
        }
    }
}

impl KeptTruth {
    /// The truth as differences take it.
    pub fn with<T>(&self, then: impl FnOnce(&Truth) -> T) -> T {
        let mean = self.mean.values();
        let standard_error = self.standard_error.as_ref().map(HalfImage::values);
        let frozen = self.frozen.as_ref().map(HalfImage::values);
        then(&Truth {
            mean: &mean,
            standard_error: standard_error.as_deref(),
            frozen: frozen.as_deref().unwrap_or(&mean),
        })
    }

    /// What the values mean.
    #[must_use]
    pub fn encoding(&self) -> Encoding {
        if self.exposures.is_some() { Encoding::Linear } else { Encoding::Display }
    }

    /// Every metric that an image has against this truth: reported, not gated.
    #[must_use]
    pub fn numbers(&self, image: &HalfImage) -> BTreeMap<String, f64> {
        let mut selection = Selection::all(self.encoding());
        selection.masks = vec![Mask::All];
        selection.flip_exposures = self.exposures;
        let layers = |image: &HalfImage| {
            let mut layers = Layers::new(image.size_px);
            layers.push(LayerName::Radiance, 3, image.values());
            layers
        };
        let (truth, image) = (layers(&self.mean), layers(image));
        let found = measure_all(Reference(&truth), Candidate(&image), &selection);
        let found = found.map(|judgement| judgement.measurements).unwrap_or_default();
        found.into_iter().filter_map(|m| Some((m.metric, m.value?))).collect()
    }
}
