//! Images of code values for a display: PNG, JPEG, TIFF, WebP, TGA and others.
//! What they say of their colours is undone, so that what is returned are code
//! values of sRGB.

mod icc;
mod other;
mod png;
mod tiff;
mod transfer;

pub(super) use self::other::read as read_other;
pub(super) use self::png::read as read_png;

use super::picture::{Alpha, Encoding};
use super::{Error, Picture, colour};
use crate::{LayerName, Layers};
use std::path::Path;
use transfer::Described;

/// Half a step of 8-bit code values: what is closer is the same.
const HALF_A_STEP: f64 = 0.5 / 255.0;

/// What the numbers of an image mean.
#[derive(Debug)]
enum Space {
    /// Code values of sRGB.
    Srgb,
    /// Code values that an ICC profile explains.
    Profile(Vec<u8>),
    /// Code values of a curve and primaries.
    Described(Described),
    /// Linear light.
    Linear,
}

/// An image as its decoder gave it.
#[derive(Debug)]
struct Raster {
    size_px: [u32; 2],
    /// R, G, B per pixel; integers are divided by their largest value.
    colours: Vec<f64>,
    /// Opacity, 0..1.
    alpha: Option<Vec<f64>>,
    /// Colours are multiplied by their opacity.
    is_multiplied: bool,
    space: Space,
    warnings: Vec<String>,
}

impl Raster {
    /// The picture: code values of sRGB (linear stays linear), alpha laid.
    ///
    /// Display images are blended in code values, as browsers and viewers do.
    fn finish(mut self, alpha: Alpha) -> Picture {
        let encoding = match std::mem::replace(&mut self.space, Space::Srgb) {
            Space::Linear => Encoding::Linear,
            Space::Srgb => Encoding::Display,
            space => {
                self.convert(&space);
                Encoding::Display
            }
        };
        if let Some(opacity) = &self.alpha {
            if self.is_multiplied {
                alpha.lay_multiplied(&mut self.colours, opacity);
            } else {
                alpha.lay(&mut self.colours, opacity);
            }
        }
        let mut layers = Layers::new(self.size_px);
        layers.push(LayerName::Radiance, 3, self.colours);
        let found = vec!["radiance".to_owned()];
        Picture { layers, encoding, alpha: self.alpha, found, warnings: self.warnings }
    }

    /// Colours of another space become code values of sRGB.
    fn convert(&mut self, space: &Space) {
        if self.is_multiplied {
            self.divide_by_alpha();
        }
        let converted = match space {
            Space::Profile(profile) => icc::to_srgb(profile, &self.colours),
            Space::Described(described) => described.to_srgb(&self.colours),
            Space::Srgb | Space::Linear => Ok(None),
        };
        match converted {
            Ok(Some(colours)) => self.colours = colours,
            Ok(None) => {}
            Err(reason) => {
                self.warnings.push(format!("{reason}: its numbers are taken as sRGB"));
            }
        }
        self.keep_in_gamut();
        if let (true, Some(alpha)) = (self.is_multiplied, &self.alpha) {
            for (pixel, alpha) in self.colours.chunks_exact_mut(3).zip(alpha) {
                pixel.iter_mut().for_each(|value| *value *= alpha);
            }
        }
    }

    fn divide_by_alpha(&mut self) {
        let Some(alpha) = &self.alpha else { return };
        for (pixel, &alpha) in self.colours.chunks_exact_mut(3).zip(alpha) {
            let by = if alpha > 0.0 { 1.0 / alpha } else { 0.0 };
            pixel.iter_mut().for_each(|value| *value = (*value * by).min(1.0));
        }
    }

    /// A display of sRGB shows 0..1.
    fn keep_in_gamut(&mut self) {
        let mut outside = 0u64;
        for pixel in self.colours.chunks_exact_mut(3) {
            let far = |value: &f64| *value < -HALF_A_STEP || *value > 1.0 + HALF_A_STEP;
            outside += u64::from(pixel.iter().any(far));
            pixel.iter_mut().for_each(|value| *value = value.clamp(0.0, 1.0));
        }
        if outside > 0 {
            self.warnings
                .push(format!("{outside} pixels lie outside sRGB and were brought to its border"));
        }
    }
}

/// Decodes code values of sRGB to linear light.
pub(super) fn to_linear(picture: &mut Picture) {
    if picture.encoding == Encoding::Display {
        for layer in &mut picture.layers.list {
            layer.data.iter_mut().for_each(|value| *value = colour::linear_from_srgb(*value));
        }
        picture.encoding = Encoding::Linear;
    }
}

/// Splits interleaved numbers into colours and opacity: 1 grey, 2 grey and
/// alpha, 3 colours, 4 colours and alpha.
fn split(
    values: impl Iterator<Item = f64>,
    channels: usize,
    pixels: usize,
) -> (Vec<f64>, Option<Vec<f64>>) {
    let mut colours = Vec::with_capacity(3 * pixels);
    let mut alpha = channels.is_multiple_of(2).then(|| Vec::with_capacity(pixels));
    for (place, value) in values.enumerate() {
        match (place % channels, &mut alpha) {
            (last, Some(alpha)) if last + 1 == channels => alpha.push(value),
            _ if channels < 3 => colours.extend([value; 3]),
            _ => colours.push(value),
        }
    }
    (colours, alpha)
}

/// What a decoder of the `image` crate says, as one of our errors.
fn from_decoder(path: &Path, error: &image::ImageError) -> Error {
    match error {
        image::ImageError::Unsupported(what) => super::error::unsupported(
            path,
            what.to_string(),
            "write it as grey or RGB of 8 or 16 bits, with or without alpha",
        ),
        image::ImageError::Limits(what) => super::error::unsupported(
            path,
            what.to_string(),
            "use an image of at most 32768 x 16384 pixels",
        ),
        other => super::error::broken(path, other),
    }
}
