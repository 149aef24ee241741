//! Reading image files: from a path, which may name a layer, to a picture.

use super::error::broken;
use super::exr::{self, Wanted};
use super::kind::{Kind, kind};
use super::picture::{Alpha, Picture};
use super::{Error, hdr, pfm, raster};
use crate::environment::LatLong;
use crate::{LayerName, Layers};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Largest file that is read, bytes.
const MOST_BYTES: u64 = 1 << 34;

/// Reads an image as what it shows.
///
/// `FILE.exr:LAYER` takes that layer of an OpenEXR file as the radiance. Without
/// it the radiance is the layer that has no name, or a name for the image, or
/// the only one with colours. Everything that a file says of its pixels is
/// obeyed, or is in [`Picture::warnings`].
///
/// # Errors
/// If the file is missing, broken, empty, of another kind, claims more pixels
/// than it can hold, or if several layers could be meant.
pub fn open(path: &Path, alpha: Alpha) -> Result<Picture, Error> {
    let (path, layer) = with_layer(path);
    picture(&path, Wanted::Image(layer.as_deref()), alpha)
}

/// Reads the layers of an image under their own names, as [`super::write_exr`]
/// wrote them; display images become linear. What the file says and is not
/// obeyed is not told: [`open`] does.
///
/// # Errors
/// Those of [`open`], but no layer has to be the image.
pub fn read(path: &Path) -> Result<Layers, Error> {
    let (path, layer) = with_layer(path);
    let wanted = layer.as_deref().map_or(Wanted::AsNamed, |layer| Wanted::Image(Some(layer)));
    let mut picture = picture(&path, wanted, Alpha::default())?;
    raster::to_linear(&mut picture);
    Ok(picture.layers)
}

/// Reads the colours of an image as a lat-long environment, as they are (bad
/// values are not repaired here), with what the file says and is not obeyed.
///
/// # Errors
/// Those of [`open`], and a file without colours.
pub fn read_lat_long(path: &Path) -> Result<(LatLong, Vec<String>), Error> {
    let mut picture = open(path, Alpha::default())?;
    raster::to_linear(&mut picture);
    let Some(radiance) = picture.layers.get(&LayerName::Radiance) else {
        return Err(Error::NoColour { path: path.to_owned(), found: picture.found.join(", ") });
    };
    let texels = radiance.data.chunks_exact(3).map(|c| [c[0] as f32, c[1] as f32, c[2] as f32]);
    let lat_long = LatLong { size_px: picture.layers.resolution_px, texels: texels.collect() };
    let mut warnings = picture.warnings;
    if picture.alpha.is_some_and(|alpha| alpha.iter().any(|alpha| *alpha != 1.0)) {
        warnings.push("it is transparent in places: they lie over black".to_owned());
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Ok((lat_long, warnings.into_iter().map(|text| format!("{name}: {text}")).collect()))
}

/// The file of a path that may name a layer, `FILE:LAYER`.
#[must_use]
pub fn file_of(path: &Path) -> PathBuf {
    with_layer(path).0
}

/// `FILE:LAYER`, where there is no file of the whole name.
fn with_layer(path: &Path) -> (PathBuf, Option<String>) {
    let text = path.to_string_lossy();
    match text.rsplit_once(':') {
        Some((file, layer)) if !path.exists() && Path::new(file).is_file() => {
            (PathBuf::from(file), Some(layer.to_owned()))
        }
        _ => (path.to_owned(), None),
    }
}

fn picture(path: &Path, wanted: Wanted, alpha: Alpha) -> Result<Picture, Error> {
    picture_of(path, &bytes(path)?, wanted, alpha)
}

/// The picture in the bytes of a file of this name.
pub(super) fn picture_of(
    path: &Path,
    bytes: &[u8],
    wanted: Wanted,
    alpha: Alpha,
) -> Result<Picture, Error> {
    let mut picture = match kind(path, bytes)? {
        Kind::Exr => return exr::read(path, bytes, wanted, alpha),
        Kind::Radiance => hdr::read(path, bytes)?,
        Kind::Pfm => pfm::read(path, bytes)?,
        Kind::Png => raster::read_png(path, bytes, alpha)?,
        Kind::Other(format) => raster::read_other(path, bytes, format, alpha)?,
    };
    if let Wanted::Image(Some(layer)) = wanted {
        let (path, layer) = (path.to_owned(), layer.to_owned());
        return Err(Error::NoLayer { path, layer, found: "one image without layers".to_owned() });
    }
    picture.warnings.dedup();
    Ok(picture)
}

fn bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let wrap = |source| Error::Open { path: path.to_owned(), source };
    let file = File::open(path).map_err(wrap)?;
    let mut bytes = Vec::new();
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(wrap)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(broken(path, "it is larger than 16 GiB"));
    }
    Ok(bytes)
}
