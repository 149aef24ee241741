//! PNG, with what it says of its colours and its opacity.
//!
//! Source: W3C, Portable Network Graphics (third edition), §4.3 (which chunk
//! goes before which) and §11.3.2.

use super::super::claim::Claim;
use super::super::colour::Chromaticities;
use super::super::error::{broken, unsupported};
use super::super::picture::Alpha;
use super::super::{Error, Picture};
use super::transfer::Described;
use super::{Raster, Space, split};
use png::{BitDepth, Decoder, Info, Transformations};
use std::io::Cursor;
use std::path::Path;

/// Reads the first image of a PNG file.
pub(in super::super) fn read(path: &Path, bytes: &[u8], alpha: Alpha) -> Result<Picture, Error> {
    let broken = |error: png::DecodingError| match error {
        png::DecodingError::LimitsExceeded => {
            unsupported(path, "it needs too much memory", "use a smaller image")
        }
        other => broken(path, other),
    };
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(broken)?;
    let (color, depth) = reader.output_color_type();
    let (width, height) = reader.info().size();
    let size_px = [u64::from(width), u64::from(height)];
    let claim = Claim { path, size_px, file_bytes: bytes.len() as u64 };
    claim.size()?;
    let needed = reader.output_buffer_size().ok_or_else(|| claim.too_short())?;
    claim.weigh(needed as u64, bytes.len() as u64, 1033)?;
    let mut warnings = Vec::new();
    if reader.info().animation_control.is_some_and(|control| control.num_frames > 1) {
        warnings.push("it is animated: the first image is taken".to_owned());
    }
    let space = space(reader.info(), &mut warnings);
    let mut buffer = vec![0; needed];
    reader.next_frame(&mut buffer).map_err(broken)?;
    let pixels = width as usize * height as usize;
    let channels = color.samples();
    let (mut colours, alpha_plane) = if depth == BitDepth::Sixteen {
        let words = buffer.as_chunks::<2>().0.iter();
        split(words.map(|word| f64::from(u16::from_be_bytes(*word)) / 65535.0), channels, pixels)
    } else {
        split(buffer.iter().map(|byte| f64::from(*byte) / 255.0), channels, pixels)
    };
    if reader.info().coding_independent_code_points.is_some_and(|c| !c.is_video_full_range_image) {
        to_full_range(&mut colours, depth);
    }
    let raster = Raster {
        size_px: [width, height],
        colours,
        alpha: alpha_plane,
        is_multiplied: false,
        space,
        warnings,
    };
    Ok(raster.finish(alpha))
}

/// The first of `cICP`, `iCCP`, `sRGB`, and `gAMA` with `cHRM` that is there.
fn space(info: &Info, warnings: &mut Vec<String>) -> Space {
    if let Some(points) = info.coding_independent_code_points {
        if points.matrix_coefficients != 0 {
            warnings.push("cICP names a matrix, which PNG has no use for".to_owned());
        }
        match Described::of_code_points(points.color_primaries, points.transfer_function) {
            Ok(described) => return Space::Described(described),
            Err(reason) => warnings.push(format!("{reason}: its numbers are taken as sRGB")),
        }
        return Space::Srgb;
    }
    if let Some(profile) = &info.icc_profile {
        return Space::Profile(profile.to_vec());
    }
    if info.srgb.is_some() {
        return Space::Srgb;
    }
    let gamma = info.gama_chunk.map(|gamma| f64::from(gamma.into_value()));
    let primaries = info.chrm_chunk.map(|chrm| {
        let xy = |(x, y): (png::ScaledFloat, png::ScaledFloat)| {
            [f64::from(x.into_value()), f64::from(y.into_value())]
        };
        let (red, green, blue) = (xy(chrm.red), xy(chrm.green), xy(chrm.blue));
        Chromaticities { red, green, blue, white: xy(chrm.white) }
    });
    Space::Described(Described::of_gamma(gamma, primaries))
}

/// Code values 16 to 235 of 8 bits (and their multiples) become 0..1.
fn to_full_range(colours: &mut [f64], depth: BitDepth) {
    let largest = if depth == BitDepth::Sixteen { 65535.0 / 256.0 } else { 255.0 };
    colours.iter_mut().for_each(|value| *value = (*value * largest - 16.0) / 219.0);
}
