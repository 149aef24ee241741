//! Two image files and how far apart they are: anybody's frames.

use crate::metric::display::srgb_encode;
use crate::metric::error::{mae, max_abs};
use crate::metric::{
    Candidate, Encoding, Exposures, Judgement, JudgementError, Mask, Measurement, Reference,
    Selection, judge,
};
use crate::results::Validity;
use scenes::LayerName;
use scenes::image::{Alpha, Picture};
use std::path::{Path, PathBuf};

/// Why two files cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum ImagePairError {
    /// A file is missing, broken, or of no known kind.
    #[error(transparent)]
    Image(#[from] scenes::image::Error),
    /// One is linear, the other encoded for display.
    #[error(
        "{} holds linear radiance, {} display code values\nencode the linear one with \
         --display ev=0 (exposure in stops, clamp, sRGB), or use two of a kind",
        linear.display(), display.display()
    )]
    Encoding {
        /// The one that holds linear radiance.
        linear: PathBuf,
        /// The one that holds code values.
        display: PathBuf,
    },
    /// An option that has nothing to do.
    #[error("{0}")]
    Option(String),
    /// No layer is in both.
    #[error(
        "{} and {} share neither an image nor an exit layer\n{} has {}\n{} has {}\nchoose a layer \
         of an OpenEXR file with FILE:LAYER", candidate.display(), reference.display(),
        reference.display(), found[0].join(", "), candidate.display(), found[1].join(", ")
    )]
    NothingShared {
        /// The reference.
        reference: PathBuf,
        /// The candidate.
        candidate: PathBuf,
        /// What layers they have.
        found: [Vec<String>; 2],
    },
    /// The pair cannot be judged.
    #[error("{} against {}: {source}", candidate.display(), reference.display())]
    Judgement {
        /// The reference.
        reference: PathBuf,
        /// The candidate.
        candidate: PathBuf,
        /// Why.
        source: JudgementError,
    },
}

/// How two files are to be compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Question {
    /// Exposures of HDR-FLIP; from the reference image if `None`.
    pub flip_exposures: Option<Exposures>,
    /// What becomes of transparent pixels.
    pub alpha: Alpha,
    /// Compare as display images: linear ones are multiplied by 2 to this power,
    /// clamped to 0..1 and encoded as sRGB.
    pub display_ev: Option<f64>,
}

/// What was found about two files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    /// The metrics.
    pub judgement: Judgement,
    /// True if one of the files has opacity.
    pub has_alpha: bool,
    /// What the files say of their pixels and is not obeyed, with their names.
    pub warnings: Vec<String>,
}

/// Compares two image files with every metric that they can have.
///
/// A coverage layer in the reference adds the object mask; opacity in either
/// adds the metric `alpha_mae`.
///
/// # Errors
/// When a file cannot be read, the two differ in size or encoding, share no
/// layer, an option has nothing to do, or the reference holds NaN or infinity.
pub fn compare_files(
    reference_path: &Path,
    candidate_path: &Path,
    question: &Question,
) -> Result<Comparison, ImagePairError> {
    let paths = [reference_path, candidate_path];
    let [mut reference, mut candidate] = [
        scenes::image::open(reference_path, question.alpha)?,
        scenes::image::open(candidate_path, question.alpha)?,
    ];
    let encoding = one_encoding(paths, [&mut reference, &mut candidate], question)?;
    let mut selection =
        Selection { flip_exposures: question.flip_exposures, ..Selection::all(encoding) };
    if reference.layers.get(&LayerName::Coverage).is_some() {
        selection.masks.push(Mask::Object);
    }
    let judged = judge(Reference(&reference.layers), Candidate(&candidate.layers), &selection);
    let mut judgement = judged.map_err(|source| {
        let (reference_path, candidate_path) = (paths[0].to_owned(), paths[1].to_owned());
        match source {
            JudgementError::NothingShared => ImagePairError::NothingShared {
                reference: reference_path,
                candidate: candidate_path,
                found: [reference.found.clone(), candidate.found.clone()],
            },
            source => ImagePairError::Judgement {
                reference: reference_path,
                candidate: candidate_path,
                source,
            },
        }
    })?;
    let has_alpha = reference.alpha.is_some() || candidate.alpha.is_some();
    if has_alpha {
        add_alpha(&mut judgement, &reference, &candidate);
    }
    let told = [&reference, &candidate].into_iter().zip(paths);
    let warnings = told.flat_map(|(picture, path)| {
        picture.warnings.iter().map(|text| format!("{}: {text}", path.display()))
    });
    Ok(Comparison { warnings: warnings.collect(), judgement, has_alpha })
}

/// Brings both to one encoding, if that was asked for.
fn one_encoding(
    paths: [&Path; 2],
    pictures: [&mut Picture; 2],
    question: &Question,
) -> Result<Encoding, ImagePairError> {
    let encodings = [pictures[0].encoding, pictures[1].encoding];
    let is_linear = |i: usize| encodings[i] == Encoding::Linear;
    let Some(ev) = question.display_ev else {
        return match encodings {
            [a, b] if a != b => {
                let linear = usize::from(!is_linear(0));
                let (linear, display) = (paths[linear].to_owned(), paths[1 - linear].to_owned());
                Err(ImagePairError::Encoding { linear, display })
            }
            [Encoding::Display, _] if question.flip_exposures.is_some() => {
                Err(ImagePairError::Option(flip_exposures_need_radiance()))
            }
            [encoding, _] => Ok(encoding),
        };
    };
    if !is_linear(0) && !is_linear(1) {
        let text = "--display: both images hold display code values already\nleave it out";
        return Err(ImagePairError::Option(text.to_owned()));
    }
    if question.flip_exposures.is_some() {
        return Err(ImagePairError::Option(flip_exposures_need_radiance()));
    }
    for picture in pictures {
        if picture.encoding == Encoding::Linear {
            encode(picture, ev);
        }
    }
    Ok(Encoding::Display)
}

fn flip_exposures_need_radiance() -> String {
    "--flip-exposures: display images have one exposure\nleave it out, or compare linear radiance"
        .to_owned()
}

/// Linear radiance as a display shows it: exposure, clamp, sRGB; NaN stays.
fn encode(picture: &mut Picture, ev: f64) {
    let radiance = picture.layers.list.iter_mut().filter(|layer| layer.name == LayerName::Radiance);
    for value in radiance.flat_map(|layer| &mut layer.data) {
        *value = srgb_encode((*value * ev.exp2()).clamp(0.0, 1.0));
    }
    picture.encoding = Encoding::Display;
}

/// Opacity is part of an image: two that differ in it alone are not equal.
fn add_alpha(judgement: &mut Judgement, reference: &Picture, candidate: &Picture) {
    let opaque = vec![1.0; reference.layers.pixels()];
    let of = |picture: &Picture| picture.alpha.clone().unwrap_or_else(|| opaque.clone());
    let (r, t) = (of(reference), of(candidate));
    if max_abs(&r, &t) > 0.0 {
        for equal in judgement.measurements.iter_mut().filter(|m| m.status == Validity::Identical) {
            let is_known = equal.value.is_some();
            equal.status = if is_known { Validity::Ok } else { Validity::Undefined };
            equal.reason =
                "the colours are equal where alpha does not hide them, alpha differs".to_owned();
        }
    }
    judgement.measurements.push(Measurement {
        metric: "alpha_mae".to_owned(),
        unit: "",
        mask: Mask::All,
        value: Some(mae(&r, &t)),
        interval: None,
        ci_of: "none: opacity is compared as it is".to_owned(),
        n: r.len() as u64,
        status: if r == t { Validity::Identical } else { Validity::Ok },
        reason: String::new(),
        formula: "mean |d| of the opacity, 0..1".to_owned(),
    });
}
