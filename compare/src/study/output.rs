//! The folder a study leaves behind.

use crate::results::{self, ResultRow, Study};
use crate::study::jobs::Made;
use crate::support::files::{self, FileError};
use crate::{Error, report};
use scenes::{LayerName, Layers};
use std::fs;
use std::path::{Path, PathBuf};

/// Place of a run's image, relative to the folder of the study.
pub(super) fn image_place(scene: &str, method: &str) -> PathBuf {
    Path::new("images").join(format!("{}.{}.exr", plain(scene), plain(method)))
}

/// Copies a stored image to its place.
pub(super) fn copy_image(made: &Made, to: &Path) -> Result<(), FileError> {
    let copy = |partial: &Path| fs::copy(&made.image, partial).map(|_| ());
    files::replace(to, |partial| copy(partial).map_err(FileError::unwritten(to)))
}

/// Writes the FLIP map of an image, for the report.
pub(super) fn write_flip(to: &Path, resolution_px: [u32; 2], map: Vec<f64>) -> Result<(), Error> {
    let mut layers = Layers::new(resolution_px);
    layers.push(LayerName::Buffer(results::FLIP_LAYER.to_owned()), 1, map);
    Ok(scenes::image::write_exr(to, &layers)?)
}

/// Writes the rows, the study, and the report made of them.
pub(super) fn write(out: &Path, study: &Study, rows: &[ResultRow]) -> Result<(), Error> {
    results::write_rows(out, rows)?;
    results::write_study(out, study)?;
    report::write(out)?;
    Ok(())
}

/// A name as part of a file name: letters, digits, `-` and `_` only.
fn plain(name: &str) -> String {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    name.chars().map(|c| if allowed(c) { c } else { '_' }).collect()
}
