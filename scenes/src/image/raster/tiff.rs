//! What a TIFF file says beside its pixels, and floats that the `image` crate does
//! not read.

use super::super::Error;
use super::super::claim::Claim;
use super::super::error::broken;
use super::{Raster, Space, split};
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;

/// Tags that the pixels alone do not tell.
#[derive(Debug, Default)]
pub(super) struct Tags {
    /// Colours are multiplied by their opacity (ExtraSamples 1).
    pub(super) is_multiplied: bool,
    pub(super) warnings: Vec<String>,
}

/// Reads them from the first image of the file. What cannot be read is left to
/// the decoder of the pixels, which says so.
///
/// Source: TIFF 6.0, Adobe 1992, section 18.
pub(super) fn tags(bytes: &[u8]) -> Tags {
    let mut tags = Tags::default();
    let Ok(mut decoder) = Decoder::new(std::io::Cursor::new(bytes)) else { return tags };
    let extra = decoder.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples);
    match extra.ok().flatten().as_deref() {
        Some([1, ..]) => tags.is_multiplied = true,
        Some([0, ..]) => tags
            .warnings
            .push("its fourth channel is not said to be alpha; it is taken as that".to_owned()),
        _ => {}
    }
    if decoder.more_images() {
        tags.warnings.push("it holds several images: the first is taken".to_owned());
    }
    tags
}

/// Floats of 16, 32 or 64 bits, grey or colour; `None` where the file holds
/// something else.
pub(super) fn floats(claim: &Claim, bytes: &[u8]) -> Result<Option<Raster>, Error> {
    // What does not open is left to the other decoder, which says why.
    let Ok(decoder) = Decoder::new(std::io::Cursor::new(bytes)) else { return Ok(None) };
    let mut decoder = decoder.with_limits(Limits::unlimited());
    let channels = match decoder.colortype() {
        Ok(ColorType::Gray(_)) => 1,
        Ok(ColorType::GrayA(_)) => 2,
        Ok(ColorType::RGB(_)) => 3,
        Ok(ColorType::RGBA(_)) => 4,
        _ => return Ok(None),
    };
    let formats = decoder.find_tag_unsigned_vec::<u16>(Tag::SampleFormat).ok().flatten();
    // 3 is IEEE floating point; 2 in PlanarConfiguration is one plane per channel.
    let is_float = formats.is_some_and(|formats| formats.iter().all(|format| *format == 3));
    let planar = decoder.find_tag_unsigned::<u16>(Tag::PlanarConfiguration).ok().flatten();
    if !is_float || planar == Some(2) && channels > 1 {
        return Ok(None);
    }
    let Ok((width, height)) = decoder.dimensions() else { return Ok(None) };
    let pixels = width as usize * height as usize;
    let size_px = [u64::from(width), u64::from(height)];
    let claim = Claim { size_px, ..*claim };
    claim.weigh(8 * (pixels * channels) as u64, claim.file_bytes, 1 << 13)?;
    let values: Vec<f64> = match decoder.read_image().map_err(|error| broken(claim.path, error))? {
        DecodingResult::F16(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::F32(values) => values.into_iter().map(f64::from).collect(),
        DecodingResult::F64(values) => values,
        _ => return Ok(None),
    };
    if values.len() != pixels * channels {
        return Ok(None);
    }
    let (colours, alpha) = split(values.into_iter(), channels, pixels);
    let Tags { is_multiplied, warnings } = tags(bytes);
    let (size_px, space) = ([width, height], Space::Linear);
    Ok(Some(Raster { size_px, colours, alpha, is_multiplied, space, warnings }))
}
