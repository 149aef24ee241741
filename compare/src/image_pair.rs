//! Two image files and how far apart they are: anybody's EXR, HDR or PNG.

use crate::metric::{
    Candidate, Encoding, Exposures, Judgement, JudgementError, Mask, Reference, Selection, judge,
};
use exr::prelude as exr;
use scenes::{LayerName, Layers};
use std::collections::BTreeMap;
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
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let result = match extension.as_str() {
        "exr" => read_exr(path).map(|layers| Image { layers, encoding: Encoding::Linear }),
        "hdr" => read_flat(path).map(|layers| Image { layers, encoding: Encoding::Linear }),
        "png" => read_flat(path).map(|layers| Image { layers, encoding: Encoding::Display }),
        _ => Err("an image to compare is an .exr, .hdr or .png file".to_owned()),
    };
    result.map_err(|reason| ImagePairError::File { path: path.to_owned(), reason })
}

/// All layers of an EXR file with one part.
fn read_exr(path: &Path) -> Result<Layers, String> {
    let image = exr::read_first_flat_layer_from_file(path).map_err(|error| error.to_string())?;
    let size = image.layer_data.size;
    let mut groups: BTreeMap<String, Vec<(usize, Vec<f64>)>> = BTreeMap::new();
    for channel in &image.layer_data.channel_data.list {
        let name = channel.name.to_string();
        let (group, component) = name.rsplit_once('.').unwrap_or(("radiance", &name));
        let Some(place) = ["R", "G", "B", "X", "Y", "Z"].iter().position(|&c| c == component)
        else {
            continue;
        };
        let values = channel.sample_data.values_as_f32().map(f64::from).collect();
        groups.entry(group.to_owned()).or_default().push((place, values));
    }
    let mut layers = Layers::new([size.0 as u32, size.1 as u32]);
    for (name, mut channels) in groups {
        channels.sort_by_key(|(place, _)| *place);
        let count = channels.len();
        if name == "radiance" && count != 3 {
            return Err("it has no R, G and B channels".to_owned());
        }
        let data = (0..layers.pixels())
            .flat_map(|pixel| channels.iter().map(move |(_, values)| values[pixel]))
            .collect();
        layers.push(LayerName::from(name.as_str()), count, data);
    }
    Ok(layers)
}

/// The colours of a PNG (code values / 255) or HDR file (radiance).
fn read_flat(path: &Path) -> Result<Layers, String> {
    let image = image::open(path).map_err(|error| error.to_string())?;
    let mut layers = Layers::new([image.width(), image.height()]);
    let data = match image {
        image::DynamicImage::ImageRgb32F(_) | image::DynamicImage::ImageRgba32F(_) => {
            image.into_rgb32f().into_raw().into_iter().map(f64::from).collect()
        }
        image::DynamicImage::ImageRgb16(_)
        | image::DynamicImage::ImageRgba16(_)
        | image::DynamicImage::ImageLuma16(_)
        | image::DynamicImage::ImageLumaA16(_) => {
            image.into_rgb16().into_raw().into_iter().map(|v| f64::from(v) / 65535.0).collect()
        }
        _ => image.into_rgb8().into_raw().into_iter().map(|v| f64::from(v) / 255.0).collect(),
    };
    layers.push(LayerName::Radiance, 3, data);
    Ok(layers)
}
