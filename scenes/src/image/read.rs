//! Reading images: every layer of an EXR, the colours of HDR and PNG.

use super::claim::weigh;
use super::{Error, Kind, kind};
use crate::environment::LatLong;
use crate::{LayerName, Layers};
use exr::prelude::{AnyChannels, FlatSamples, Layer, MetaData, ReadChannels, ReadLayers};
use image::ImageDecoder;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Reads an image file.
///
/// EXR: `R,G,B` (or a lone `Y`, repeated) become [`LayerName::Radiance`], and
/// `name.channel` a channel of the layer `name`; channels of a part with a name
/// belong to the layer of that name. HDR: radiance. PNG: decoded from sRGB to
/// linear; transparency is dropped.
///
/// # Errors
/// If the file is missing, broken, empty, of another kind, or claims more pixels
/// than it can hold.
pub fn read(path: &Path) -> Result<Layers, Error> {
    match kind(path)? {
        Kind::Exr => read_exr(path),
        Kind::Hdr => read_hdr(path),
        Kind::Png => read_png(path),
    }
}

/// Reads the colours of an image as a lat-long environment, as they are: bad
/// values are not repaired here.
///
/// # Errors
/// Those of [`read`], and a file without colours.
pub fn read_lat_long(path: &Path) -> Result<LatLong, Error> {
    let layers = read(path)?;
    let Some(radiance) = layers.get(&LayerName::Radiance) else {
        let found: Vec<String> = layers.list.iter().map(|layer| layer.name.to_string()).collect();
        return Err(Error::NoColour { path: path.to_owned(), found: found.join(", ") });
    };
    let texels = radiance.data.chunks_exact(3).map(|c| [c[0] as f32, c[1] as f32, c[2] as f32]);
    Ok(LatLong { size_px: layers.resolution_px, texels: texels.collect() })
}

fn open(path: &Path) -> Result<(File, u64), Error> {
    let wrap = |source| Error::Open { path: path.to_owned(), source };
    let file = File::open(path).map_err(wrap)?;
    let bytes = file.metadata().map_err(wrap)?.len();
    Ok((file, bytes))
}

fn broken(path: &Path, reason: impl ToString) -> Error {
    Error::Broken { path: path.to_owned(), reason: reason.to_string() }
}

fn read_exr(path: &Path) -> Result<Layers, Error> {
    let (file, bytes) = open(path)?;
    let meta = MetaData::read_from_buffered(BufReader::new(file), false)
        .map_err(|error| broken(path, error))?;
    for header in &meta.headers {
        let size = [header.layer_size.width() as u64, header.layer_size.height() as u64];
        // Samples are kept as f64 beside what the decoder holds.
        weigh(path, size, 12 * header.channels.list.len() as u64, bytes)?;
    }
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_file(path)
        .map_err(|error| broken(path, error))?;
    let Some(first) = image.layer_data.first() else {
        return Err(broken(path, "it has no layers"));
    };
    let size = first.size;
    if image.layer_data.iter().any(|part| part.size != size) {
        return Err(Error::Sizes(path.to_owned()));
    }
    let mut layers = Layers::new([size.width() as u32, size.height() as u32]);
    for (name, channels) in grouped(&image.layer_data) {
        push(&mut layers, &name, &channels);
    }
    Ok(layers)
}

/// Components of a layer by their order: R, G, B or X, Y, Z.
type Components<'a> = BTreeMap<usize, &'a FlatSamples>;

/// Channels by the layer they belong to.
fn grouped(parts: &[Layer<AnyChannels<FlatSamples>>]) -> BTreeMap<String, Components<'_>> {
    let mut groups: BTreeMap<String, Components<'_>> = BTreeMap::new();
    for part in parts {
        let prefix = part.attributes.layer_name.as_ref().map(ToString::to_string);
        for channel in &part.channel_data.list {
            let name = channel.name.to_string();
            let (group, component) = match name.rsplit_once('.') {
                Some((group, component)) => (group.to_owned(), component),
                None => (prefix.clone().unwrap_or_default(), name.as_str()),
            };
            let place = ["R", "G", "B", "X", "Y", "Z"].iter().position(|c| *c == component);
            if let Some(place) = place {
                groups.entry(group).or_default().insert(place, &channel.sample_data);
            }
        }
    }
    groups
}

fn push(layers: &mut Layers, group: &str, components: &Components<'_>) {
    let unnamed = ["", "radiance", "rgba", "RGBA", "Combined"].contains(&group);
    let name = if unnamed { LayerName::Radiance } else { LayerName::from(group) };
    let mut planes: Vec<Vec<f64>> = components
        .values()
        .map(|samples| samples.values_as_f32().map(f64::from).collect())
        .collect();
    if name == LayerName::Radiance && planes.len() == 1 {
        planes = vec![planes[0].clone(), planes[0].clone(), planes[0].clone()];
    }
    let whole = planes.iter().all(|plane| plane.len() == layers.pixels());
    let colour = name != LayerName::Radiance || planes.len() == 3;
    // Subsampled or superfluous channels are no layers of ours.
    if whole && colour && layers.get(&name).is_none() {
        let data = (0..layers.pixels()).flat_map(|i| planes.iter().map(move |plane| plane[i]));
        let data = data.collect();
        layers.push(name, planes.len(), data);
    }
}

fn read_hdr(path: &Path) -> Result<Layers, Error> {
    let (file, bytes) = open(path)?;
    let decoder = image::codecs::hdr::HdrDecoder::new(BufReader::new(file))
        .map_err(|error| broken(path, error))?;
    let values = decode(path, decoder, bytes)?.into_rgb32f();
    Ok(radiance(
        [values.width(), values.height()],
        values.into_raw().into_iter().map(f64::from).collect(),
    ))
}

fn read_png(path: &Path) -> Result<Layers, Error> {
    let (file, bytes) = open(path)?;
    let decoder = image::codecs::png::PngDecoder::new(BufReader::new(file))
        .map_err(|error| broken(path, error))?;
    let image = decode(path, decoder, bytes)?.into_rgb16();
    let size = [image.width(), image.height()];
    let linear = image.into_raw().into_iter().map(|v| linear_from_srgb(f64::from(v) / 65535.0));
    Ok(radiance(size, linear.collect()))
}

fn decode(
    path: &Path,
    decoder: impl ImageDecoder,
    file_bytes: u64,
) -> Result<image::DynamicImage, Error> {
    let (width, height) = decoder.dimensions();
    weigh(path, [width, height].map(u64::from), 36, file_bytes)?;
    image::DynamicImage::from_decoder(decoder).map_err(|error| broken(path, error))
}

fn radiance(size_px: [u32; 2], data: Vec<f64>) -> Layers {
    let mut layers = Layers::new(size_px);
    layers.push(LayerName::Radiance, 3, data);
    layers
}

/// Linear value of an sRGB code value in [0, 1].
///
/// Source: IEC 61966-2-1:1999.
pub(super) fn linear_from_srgb(code: f64) -> f64 {
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}
