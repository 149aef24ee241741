//! Two image files and how far apart they are: anybody's EXR, HDR or PNG.

use crate::metric::{
    Candidate, Encoding, Exposures, Judgement, JudgementError, Mask, Reference, Selection, judge,
};
use scenes::{LayerName, Layers};
use std::path::{Path, PathBuf};

/// An image file with what its values mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Its layers: `R,G,B` is the radiance, `name.channel` a channel of `name`.
    pub layers: Layers,
    /// Linear for EXR and HDR, display code values / 255 for PNG.
    pub encoding: Encoding,
}

/// Why two files cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum ImagePairError {
    /// A file is missing, broken, or of no known kind.
    #[error(transparent)]
    Image(#[from] scenes::image::Error),
    /// A PNG is missing or broken.
    #[error("{}: {reason}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong and what would be right.
        reason: String,
    },
    /// One is linear, the other encoded for display.
    #[error(
        "{} and {} cannot be compared: EXR and HDR hold linear radiance, PNG display code \
         values; convert one of them", reference.display(), candidate.display()
    )]
    Encoding {
        /// The reference.
        reference: PathBuf,
        /// The candidate.
        candidate: PathBuf,
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

/// Compares two image files with every metric that they can have.
///
/// The exposures of HDR-FLIP come from the reference image when none are
/// given. A coverage layer in the reference adds the object mask.
///
/// # Errors
/// When a file cannot be read, the two differ in size or encoding, share no
/// layer, or the reference holds NaN or infinity.
pub fn compare_files(
    reference_path: &Path,
    candidate_path: &Path,
    flip_exposures: Option<Exposures>,
) -> Result<Judgement, ImagePairError> {
    let (reference, candidate) = (read_image(reference_path)?, read_image(candidate_path)?);
    let paths = || (reference_path.to_owned(), candidate_path.to_owned());
    if reference.encoding != candidate.encoding {
        let (reference, candidate) = paths();
        return Err(ImagePairError::Encoding { reference, candidate });
    }
    let mut selection = Selection { flip_exposures, ..Selection::all(reference.encoding) };
    if reference.layers.get(&LayerName::Coverage).is_some() {
        selection.masks.push(Mask::Object);
    }
    judge(Reference(&reference.layers), Candidate(&candidate.layers), &selection).map_err(
        |source| {
            let (reference, candidate) = paths();
            ImagePairError::Judgement { reference, candidate, source }
        },
    )
}

/// Reads an EXR, HDR or PNG file.
///
/// # Errors
/// When the file is missing, broken, or of another kind.
pub fn read_image(path: &Path) -> Result<Image, ImagePairError> {
    let extension = path.extension().unwrap_or_default();
    if extension.eq_ignore_ascii_case("png") {
        let layers = read_code_values(path)
            .map_err(|reason| ImagePairError::File { path: path.to_owned(), reason })?;
        return Ok(Image { layers, encoding: Encoding::Display });
    }
    Ok(Image { layers: scenes::image::read(path)?, encoding: Encoding::Linear })
}

/// The code values of a PNG, 0..1, as they are: metrics of displayed images
/// are defined on them, not on the light that they stand for.
fn read_code_values(path: &Path) -> Result<Layers, String> {
    let image = image::open(path).map_err(|error| error.to_string())?;
    let mut layers = Layers::new([image.width(), image.height()]);
    let deep = image.color().bytes_per_pixel() / image.color().channel_count() > 1;
    let data = if deep {
        image.into_rgb16().into_raw().into_iter().map(|v| f64::from(v) / 65535.0).collect()
    } else {
        image.into_rgb8().into_raw().into_iter().map(|v| f64::from(v) / 255.0).collect()
    };
    layers.push(LayerName::Radiance, 3, data);
    Ok(layers)
}
