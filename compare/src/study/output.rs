//! The folder a study leaves behind.

use crate::results::{self, ResultRow, Run, Study};
use crate::support::files::{self, FileError};
use crate::{Error, report};
use realtime::Method;
use scenes::{LayerName, Layers};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Name of a job's image in its folder.
pub(super) const IMAGE: &str = "image.exr";
/// Name of a job's FLIP map in its folder.
pub(super) const FLIP: &str = "flip.exr";

/// Place of a run's image, relative to the folder of the study.
fn image_place(scene: &str, method: &str) -> PathBuf {
    Path::new("images").join(format!("{}.{}.exr", plain(scene), plain(method)))
}

/// What a file tells of itself: the row's own names.
pub(super) fn attributes(row: &ResultRow) -> BTreeMap<String, String> {
    let set = row.columns.0.iter().map(|(name, value)| (name.clone(), value.to_string()));
    let named = [("id", &row.id), ("scene", &row.scene), ("method", &row.method)];
    let named = named.map(|(name, value)| (name.to_owned(), value.clone()));
    let positions = ("positions".to_owned(), row.positions.to_string());
    set.chain(named).chain([positions]).collect()
}

/// Writes the image of a row.
pub(super) fn write_image(to: &Path, layers: &Layers, row: &ResultRow) -> Result<(), Error> {
    Ok(scenes::image::write_exr_with(to, layers, &attributes(row))?)
}

/// Copies the images of a run, which lie in a folder of its own, to their places in
/// the folder of the study.
pub(super) fn keep(run: &mut Run, from: &Path, out: &Path) -> Result<(), FileError> {
    let image = image_place(&run.scene, &run.method);
    let flip = image.with_extension("flip.exr");
    for (kept, place) in [(&mut run.image, image), (&mut run.flip_map, flip)] {
        if !kept.as_os_str().is_empty() {
            copy(&from.join(&kept), &out.join(&place))?;
            *kept = place;
        }
    }
    Ok(())
}

fn copy(from: &Path, to: &Path) -> Result<(), FileError> {
    let copy = |partial: &Path| fs::copy(from, partial).map(|_| ());
    files::replace(to, |partial| copy(partial).map_err(FileError::unwritten(to)))
}

/// Writes the FLIP map of a row's image, for the report.
pub(super) fn write_flip(to: &Path, row: &ResultRow, map: Vec<f64>) -> Result<(), Error> {
    let resolution_px = [row.width_px, row.height_px];
    let mut layers = Layers::new(resolution_px);
    layers.push(LayerName::Buffer(results::FLIP_LAYER.to_owned()), 1, map);
    write_image(to, &layers, row)
}

/// Writes the rows, the study, and the report made of them.
pub(super) fn write(out: &Path, study: &Study, rows: &[ResultRow]) -> Result<(), Error> {
    results::write_rows(out, rows)?;
    results::write_study(out, study)?;
    keep_methods(out, study)?;
    report::write(out, report::Options::default())?;
    Ok(())
}

/// Keeps the WGSL of methods from users' files.
fn keep_methods(out: &Path, study: &Study) -> Result<(), Error> {
    for run in &study.runs {
        if let Some(text) = Method::find(&run.method).ok().and_then(Method::file_text) {
            let place = out.join("methods").join(format!("{}.wgsl", plain(&run.method)));
            files::make_folder_of(&place)?;
            files::write(&place, text.as_bytes())?;
        }
    }
    Ok(())
}

/// A name as part of a file name: letters, digits, `-` and `_` only.
fn plain(name: &str) -> String {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    name.chars().map(|c| if allowed(c) { c } else { '_' }).collect()
}
