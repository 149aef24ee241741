//! Writing images: all layers as EXR, a preview as PNG. A file appears under
//! its name only when it is whole.

use super::Error;
use super::colour::srgb_from_linear;
use crate::{Layer, LayerName, Layers};
use ::exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatSamples, Image, LayerAttributes, Text,
    WritableImage,
};
use std::collections::BTreeMap;
use std::path::Path;

/// How linear radiance becomes a picture for a screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preview {
    /// Radiance is multiplied by 2 to this power.
    pub exposure_stops: f64,
    /// Curve from radiance to display-linear values.
    pub tone_map: ToneMap,
}

/// Curves from radiance to display-linear values; the sRGB transfer function
/// follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToneMap {
    /// Values above 1 are cut off.
    Clip,
    /// Per channel x (1 + x / 16) / (1 + x): white at radiance 4.
    ///
    /// Source: Reinhard, Stark, Shirley and Ferwerda, Photographic tone
    /// reproduction for digital images, SIGGRAPH 2002, eq. 4.
    Reinhard,
}

impl Default for Preview {
    fn default() -> Self {
        Self { exposure_stops: 0.0, tone_map: ToneMap::Reinhard }
    }
}

impl Preview {
    /// Code value 0 to 255 of a linear radiance; NaN becomes 0.
    #[must_use]
    pub fn code(&self, radiance: f64) -> u8 {
        let exposed = radiance * self.exposure_stops.exp2();
        let exposed = if exposed.is_nan() { 0.0 } else { exposed.clamp(0.0, 1e30) };
        let display = match self.tone_map {
            ToneMap::Clip => exposed,
            ToneMap::Reinhard => exposed * (1.0 + exposed / 16.0) / (1.0 + exposed),
        };
        (255.0 * srgb_from_linear(display.min(1.0))).round() as u8
    }
}

/// Writes every layer as f32, ZIP-compressed: the radiance as `R,G,B`, others
/// as `name.channel`.
///
/// # Errors
/// If the file cannot be written, or there is no pixel or no layer.
pub fn write_exr(path: &Path, layers: &Layers) -> Result<(), Error> {
    write_exr_with(path, layers, &BTreeMap::new())
}

/// As [`write_exr`], with text attributes in UTF-8; each name is written as
/// `snell:name`.
///
/// # Errors
/// Those of [`write_exr`].
pub fn write_exr_with(
    path: &Path,
    layers: &Layers,
    attributes: &BTreeMap<String, String>,
) -> Result<(), Error> {
    let [width, height] = layers.resolution_px.map(|n| n as usize);
    if width == 0 || height == 0 {
        let [width, height] = layers.resolution_px.map(u64::from);
        return Err(Error::Empty { path: path.to_owned(), width, height });
    }
    let channels: Vec<_> = layers.list.iter().flat_map(channels_of).collect();
    if channels.is_empty() {
        return Err(write_error(path, "the image has no layers"));
    }
    let software = Text::from(concat!("snell ", env!("CARGO_PKG_VERSION")));
    let mut named = LayerAttributes { software_name: Some(software), ..Default::default() };
    for (name, value) in attributes {
        // A name ends the header's list where it is empty, and the text where it is null.
        let text = |text: &str| Text::from_slice_unchecked(text.replace('\0', " ").as_bytes());
        named.other.insert(text(&format!("snell:{name}")), AttributeValue::Text(text(value)));
    }
    let part = ::exr::prelude::Layer::new(
        (width, height),
        named,
        Encoding::SMALL_LOSSLESS,
        AnyChannels::sort(channels.into_iter().collect()),
    );
    // One buffer, one write: the encoder seeks, a half file is never seen.
    let mut encoded = std::io::Cursor::new(Vec::new());
    let image = Image::from_layer(part);
    image.write().to_buffered(&mut encoded).map_err(|error| write_error(path, error))?;
    crate::whole::write(path, encoded.get_ref()).map_err(|error| write_error(path, error))
}

fn channels_of(layer: &Layer) -> impl Iterator<Item = AnyChannel<FlatSamples>> + '_ {
    (0..layer.channels).map(|channel| {
        let samples = layer.data.iter().skip(channel).step_by(layer.channels);
        let samples = samples.map(|value| to_f32(*value)).collect();
        let name = channel_name(layer, channel);
        AnyChannel::new(Text::new_or_panic(latin(&name)), FlatSamples::F32(samples))
    })
}

/// Channel names follow the OpenEXR convention.
fn channel_name(layer: &Layer, channel: usize) -> String {
    let colour =
        matches!(layer.name, LayerName::Radiance | LayerName::Variance | LayerName::Bounce(_));
    let component = match (layer.channels, colour) {
        (1, _) => "Y",
        (_, true) => ["R", "G", "B"].get(channel).unwrap_or(&"A"),
        _ => ["X", "Y", "Z"].get(channel).unwrap_or(&"W"),
    };
    match layer.name {
        LayerName::Radiance => component.to_owned(),
        _ => format!("{}.{component}", layer.name),
    }
}

/// EXR names are Latin-1.
fn latin(name: &str) -> String {
    name.chars().map(|c| if u32::from(c) < 256 { c } else { '_' }).collect()
}

/// The nearest f32; finite values stay finite.
fn to_f32(value: f64) -> f32 {
    let narrow = value as f32;
    if narrow.is_infinite() && value.is_finite() { f32::MAX.copysign(narrow) } else { narrow }
}

/// Writes the radiance as 8-bit sRGB.
///
/// # Errors
/// If there is no radiance, or the file cannot be written.
pub fn write_png(path: &Path, layers: &Layers, preview: &Preview) -> Result<(), Error> {
    let Some(radiance) = layers.get(&LayerName::Radiance) else {
        return Err(write_error(path, "the image has no radiance layer to show"));
    };
    let codes: Vec<u8> = radiance.data.iter().map(|value| preview.code(*value)).collect();
    let [width, height] = layers.resolution_px;
    let mut encoded = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(
        &mut encoded,
        &codes,
        width,
        height,
        image::ExtendedColorType::Rgb8,
        image::ImageFormat::Png,
    )
    .map_err(|error| write_error(path, error))?;
    crate::whole::write(path, encoded.get_ref()).map_err(|error| write_error(path, error))
}

fn write_error(path: &Path, reason: impl ToString) -> Error {
    Error::Write { path: path.to_owned(), reason: reason.to_string() }
}
