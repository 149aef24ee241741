//! OpenEXR files. A pixel's place is that of the data window in the display
//! window; what the file does not cover is black.
//!
//! Read this first: headers say what there is, names say what belongs together,
//! blocks are found and weighed, codecs unpack them, and `place` puts samples
//! where they belong.

mod block;
mod blocks;
mod chroma;
mod codec;
mod header;
mod names;
mod place;

use super::claim::Claim;
use super::error::{broken, unsupported};
use super::picture::Alpha;
use super::{Error, Picture, colour};
use crate::{LayerName, Layers};
use codec::Codec;
use header::{Headers, Part, Window};
use names::{Choice, Content, Group};
use std::path::Path;

/// Samples that need no data, four channels of 8192 x 4096 pixels.
const FREE_SAMPLES: u64 = 1 << 27;
/// How much larger than its data a larger display window may be.
const MOST_BLACK: u64 = 4;

/// What becomes the radiance.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wanted<'a> {
    /// What has no other name; layers keep their names.
    AsNamed,
    /// What the file shows: the layer of that name, or the one that can be it.
    Image(Option<&'a str>),
}

/// Reads the full resolution of every layer.
pub(super) fn read(
    path: &Path,
    bytes: &[u8],
    wanted: Wanted,
    alpha: Alpha,
) -> Result<Picture, Error> {
    if let Some(version @ 3..) = header::version(bytes) {
        let advice = "write it as version 2, as OpenEXR does since 2013";
        return Err(unsupported(path, format!("is OpenEXR of version {version}"), advice));
    }
    let headers = Headers::parse(bytes).map_err(|reason| broken(path, reason))?;
    let parts = &headers.parts;
    if parts.iter().any(|part| part.is_deep) {
        let advice = "flatten it first: an image with one sample per pixel is read";
        return Err(unsupported(path, "holds deep data (several samples per pixel)", advice));
    }
    let codecs: Result<Vec<Codec>, String> =
        parts.iter().map(|part| Codec::of(part.compression)).collect();
    let codecs = codecs.map_err(|name| {
        let advice = "write it with another compression, such as ZIP, PIZ or DWAA";
        unsupported(path, format!("its compression {name} is not read"), advice)
    })?;
    let mut groups = names::groups(parts);
    let image = image_of(path, &mut groups, parts, wanted)?;
    let display =
        image.map_or(parts[0].display, |group| parts[groups[group].channels[0].0].display);
    check_sizes(path, parts, display, bytes.len() as u64)?;
    let claim = claim_of(path, display, bytes.len() as u64);
    let blocks = blocks::locate(&claim, &headers, &codecs, bytes)?;
    let planes = place::planes(parts, &codecs, &blocks, display, &groups)
        .map_err(|reason| broken(path, reason))?;
    let found = names::described(&groups, parts);
    let mut picture = Picture { found, warnings: warnings(parts, display), ..Picture::default() };
    picture.layers = Layers::new(display.size_px().map(|side| side as u32));
    for (number, (group, planes)) in groups.iter().zip(planes).enumerate() {
        let is_image = image == Some(number);
        push(&mut picture, parts, group, planes, is_image.then_some(alpha));
    }
    Ok(picture)
}

/// The group that is the radiance, if there is one.
fn image_of(
    path: &Path,
    groups: &mut Vec<Group>,
    parts: &[Part],
    wanted: Wanted,
) -> Result<Option<usize>, Error> {
    let path = || path.to_owned();
    match wanted {
        Wanted::AsNamed => Ok(names::unnamed(groups)),
        Wanted::Image(None) => match names::image(groups) {
            Choice::Group(group) => Ok(Some(group)),
            Choice::None => Ok(None),
            Choice::Ambiguous(layers) => Err(Error::Ambiguous { path: path(), layers }),
        },
        Wanted::Image(Some(layer)) => match names::chosen(groups, parts, layer) {
            Some(group) => Ok(Some(group)),
            None => {
                let found = names::described(groups, parts).join(", ");
                Err(Error::NoLayer { path: path(), layer: layer.to_owned(), found })
            }
        },
    }
}

/// How many blocks there are: all of them were found and weighed.
#[cfg(test)]
pub(super) fn located(claim: &Claim, bytes: &[u8]) -> Result<usize, Error> {
    let headers = Headers::parse(bytes).map_err(|reason| broken(claim.path, reason))?;
    let codecs: Result<Vec<Codec>, String> =
        headers.parts.iter().map(|part| Codec::of(part.compression)).collect();
    let codecs = codecs.map_err(|reason| broken(claim.path, reason))?;
    Ok(blocks::locate(claim, &headers, &codecs, bytes)?.len())
}

fn claim_of(path: &Path, window: Window, file_bytes: u64) -> Claim<'_> {
    Claim { path, size_px: window.size_px(), file_bytes }
}

fn check_sizes(path: &Path, parts: &[Part], display: Window, bytes: u64) -> Result<(), Error> {
    for part in parts {
        claim_of(path, part.data, bytes).size()?;
    }
    let claim = claim_of(path, display, bytes);
    claim.size()?;
    // What is not in the file is black, but takes as much memory.
    let channels: u64 = parts.iter().map(|part| part.channels.len() as u64).sum();
    let samples = |part: &Part| part.data.pixels().saturating_mul(part.channels.len() as u64);
    let data = parts.iter().map(samples).fold(0, u64::saturating_add);
    let shown = display.pixels().saturating_mul(channels);
    if shown > FREE_SAMPLES.max(data.saturating_mul(MOST_BLACK)) {
        return Err(claim.refused("its data window is a speck in that: crop the display window"));
    }
    Ok(())
}

fn warnings(parts: &[Part], display: Window) -> Vec<String> {
    let mut warnings = Vec::new();
    for part in parts {
        let name =
            if part.name.is_empty() { String::new() } else { format!("part {}: ", part.name) };
        let outside = |axis: usize| {
            part.data.max[axis] < display.min[axis] || part.data.min[axis] > display.max[axis]
        };
        if outside(0) || outside(1) {
            warnings.push(format!(
                "{name}the data window lies outside the display window: the image is black"
            ));
        }
        if part.display != display {
            warnings.push(format!("{name}its display window is another one and is not used"));
        }
        if part.is_cube {
            warnings.push(format!("{name}the image is the six faces of a cube (envmap)"));
        }
    }
    warnings
}

/// Adds a layer; `alpha` is given for the one that is the image.
fn push(
    picture: &mut Picture,
    parts: &[Part],
    group: &Group,
    planes: place::Planes,
    alpha: Option<Alpha>,
) {
    let place::Planes { mut data, mut channels, alpha: opacity } = planes;
    let part = &parts[group.channels[0].0];
    if let Some(alpha) = alpha {
        let chromaticities = part.chromaticities.unwrap_or(colour::REC_709);
        if group.content == Content::LuminanceChroma {
            let weights = chromaticities.luminance_weights();
            let weights = weights.or_else(|| colour::REC_709.luminance_weights());
            chroma::to_rgb(&mut data, weights.unwrap_or(glam::DVec3::splat(1.0 / 3.0)));
        }
        if channels != 3 {
            (data, channels) = (three(picture, group, &data, channels), 3);
        }
        let is_colour = matches!(group.content, Content::Colour | Content::LuminanceChroma);
        if is_colour && !chromaticities.is_rec_709() {
            match chromaticities.rec_709_from_rgb() {
                Some(matrix) => colour::transform(&mut data, &matrix),
                None => picture
                    .warnings
                    .push("chromaticities do not span the colours; Rec. 709 is taken".to_owned()),
            }
        }
        if let Some(opacity) = &opacity {
            alpha.lay_multiplied(&mut data, opacity);
        }
        picture.alpha = opacity;
        picture.layers.list.retain(|layer| layer.name != LayerName::Radiance);
        picture.layers.push(LayerName::Radiance, channels, data);
        return;
    }
    let name = LayerName::from(&*group.name);
    let is_free = !group.name.is_empty() && name != LayerName::Radiance;
    if is_free && picture.layers.get(&name).is_none() {
        picture.layers.push(name, channels, data);
    }
}

/// Three values per pixel where the layer has another number of them: one is
/// grey, and of several those that are missing are 0.
fn three(picture: &mut Picture, group: &Group, data: &[f64], channels: usize) -> Vec<f64> {
    if channels == 1 {
        return data.iter().flat_map(|value| [*value; 3]).collect();
    }
    let missing: Vec<&str> = ["R", "G", "B"].into_iter().filter(|c| !group.has(c)).collect();
    picture.warnings.push(format!("the image has no channel {}: it is 0", missing.join(", ")));
    let places = ["R", "G", "B"].map(|component| group.place(component));
    let pixels = data.chunks_exact(channels);
    pixels.flat_map(|pixel| places.map(|place| place.map_or(0.0, |place| pixel[place]))).collect()
}
