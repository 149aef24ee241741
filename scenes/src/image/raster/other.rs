//! Other files that people keep frames in, by the decoders of the `image` crate.

use super::super::claim::Claim;
use super::super::picture::Alpha;
use super::super::{Error, Picture};
use super::{Raster, Space, from_decoder, split, tiff};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageFormat, ImageReader};
use std::io::Cursor;
use std::path::Path;

/// More bytes of pixels than these codecs make of one: an image of one colour
/// takes next to nothing in WebP and progressive JPEG.
const MOST_PER_BYTE: u64 = 1 << 13;

/// Reads TIFF, JPEG, WebP, TGA, BMP, PPM and QOI. Integers are code values of
/// sRGB unless a profile says otherwise; floats are linear light.
pub(in super::super) fn read(
    path: &Path,
    bytes: &[u8],
    format: ImageFormat,
    alpha: Alpha,
) -> Result<Picture, Error> {
    let wrong = |error: image::ImageError| from_decoder(path, &error);
    let file = Claim { path, size_px: [1, 1], file_bytes: bytes.len() as u64 };
    if format == ImageFormat::Tiff
        && let Some(raster) = tiff::floats(&file, bytes)?
    {
        return Ok(raster.finish(alpha));
    }
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    // The claim is weighed here.
    reader.no_limits();
    let mut decoder = reader.into_decoder().map_err(wrong)?;
    let (width, height) = decoder.dimensions();
    let size_px = [u64::from(width), u64::from(height)];
    let claim = Claim { size_px, ..file };
    claim.weigh(decoder.total_bytes(), bytes.len() as u64, MOST_PER_BYTE)?;
    let mut warnings = Vec::new();
    let is_cmyk = matches!(decoder.original_color_type(), ExtendedColorType::Cmyk8);
    if is_cmyk || format == ImageFormat::Jpeg && components(bytes) == Some(4) {
        warnings.push("its inks (CMYK) are made RGB without a profile".to_owned());
    }
    let profile = decoder.icc_profile().ok().flatten();
    let orientation = decoder.orientation().map_err(wrong)?;
    let tags = if format == ImageFormat::Tiff { tiff::tags(bytes) } else { tiff::Tags::default() };
    warnings.extend(tags.warnings);
    let mut image = DynamicImage::from_decoder(decoder).map_err(wrong)?;
    image.apply_orientation(orientation);
    let size_px = [image.width(), image.height()];
    let is_linear = matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
    if is_linear && profile.is_some() {
        warnings.push("its ICC profile is not applied to floats, taken as linear".to_owned());
    }
    let space = match profile {
        _ if is_linear => Space::Linear,
        Some(profile) => Space::Profile(profile),
        None => Space::Srgb,
    };
    let (colours, alpha_plane) = values(image);
    let is_multiplied = tags.is_multiplied;
    let raster = Raster { size_px, colours, alpha: alpha_plane, is_multiplied, space, warnings };
    Ok(raster.finish(alpha))
}

/// How many components the frame header of a JPEG file tells (ITU-T T.81, B.2.2).
fn components(bytes: &[u8]) -> Option<u8> {
    let mut at = 2;
    loop {
        let [0xff, marker, high, low, ..] = *bytes.get(at..)? else { return None };
        let is_frame = matches!(marker, 0xc0..=0xcf) && !matches!(marker, 0xc4 | 0xc8 | 0xcc);
        if is_frame {
            return bytes.get(at + 9).copied();
        }
        at += 2 + usize::from(u16::from_be_bytes([high, low])).max(2);
    }
}

/// The numbers of an image, integers divided by their largest value.
fn values(image: DynamicImage) -> (Vec<f64>, Option<Vec<f64>>) {
    let pixels = image.width() as usize * image.height() as usize;
    let channels = usize::from(image.color().channel_count());
    let bytes =
        |values: Vec<u8>| split(values.into_iter().map(|v| f64::from(v) / 255.0), channels, pixels);
    let words = |values: Vec<u16>| {
        split(values.into_iter().map(|v| f64::from(v) / 65535.0), channels, pixels)
    };
    match image {
        DynamicImage::ImageLuma8(image) => bytes(image.into_raw()),
        DynamicImage::ImageLumaA8(image) => bytes(image.into_raw()),
        DynamicImage::ImageRgb8(image) => bytes(image.into_raw()),
        DynamicImage::ImageRgba8(image) => bytes(image.into_raw()),
        DynamicImage::ImageLuma16(image) => words(image.into_raw()),
        DynamicImage::ImageLumaA16(image) => words(image.into_raw()),
        DynamicImage::ImageRgb16(image) => words(image.into_raw()),
        DynamicImage::ImageRgba16(image) => words(image.into_raw()),
        DynamicImage::ImageRgb32F(image) => {
            split(image.into_raw().into_iter().map(f64::from), 3, pixels)
        }
        other => split(other.into_rgba32f().into_raw().into_iter().map(f64::from), 4, pixels),
    }
}
