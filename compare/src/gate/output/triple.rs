//! Exact, base and head of a cell as images, and where head is worse.

use crate::Error;
use crate::gate::cell::judge::Material;
use crate::gate::difference::{mean_image, relmse_map};
use crate::gate::file::half_image::HalfImage;
use crate::metric::Encoding;
use crate::report::pictures::colour_map;
use crate::report::pictures::{Picture, contact_sheet};
use crate::support::files;
use scenes::{LayerName, Layers};
use std::path::{Path, PathBuf};

/// Writes `triple.png`, `triple.exr` (layers `exact`, `base`, `head`, `worse`) and
/// the three as EXR files of their own into a folder per cell, and returns it.
///
/// In the picture stand exact, base and head at one exposure, and where head is
/// worse (red) or better (blue).
///
/// # Errors
/// If a file cannot be written.
pub fn write(material: &Material, out: &Path) -> Result<PathBuf, Error> {
    let folder = out.join(folder_name(&material.name));
    let of = |images: &[HalfImage]| images.iter().map(HalfImage::values).collect::<Vec<_>>();
    let (head, base) = (of(&material.head), of(&material.base.images));
    let head: Vec<&[f64]> = head.iter().map(Vec::as_slice).collect();
    let base: Vec<&[f64]> = base.iter().map(Vec::as_slice).collect();
    let worse = material.truth.with(|truth| relmse_map(truth, &head, &base));
    let exact = material.truth.mean.values();
    let (head, base) = (mean_image(&head), mean_image(&base));
    let size_px = material.truth.mean.size_px;

    let mut all = Layers::new(size_px);
    for (name, values) in [("exact", &exact), ("base", &base), ("head", &head)] {
        let mut one = Layers::new(size_px);
        one.push(LayerName::Radiance, 3, values.clone());
        let path = folder.join(format!("{name}.exr"));
        files::make_folder_of(&path)?;
        scenes::image::write_exr(&path, &one)?;
        all.push(LayerName::Buffer(name.to_owned()), 3, values.clone());
    }
    all.push(LayerName::Buffer("worse".to_owned()), 1, worse.clone());
    scenes::image::write_exr(&folder.join("triple.exr"), &all)?;

    let size = size_px.map(|side| side as usize);
    let ev = colour_map::exposure(&exact);
    let linear = material.truth.encoding() == Encoding::Linear;
    let show = |values: &[f64]| match linear {
        true => Picture::of_radiance(values, size, ev),
        false => Picture::from_fn(size, |i| [0, 1, 2].map(|c| code(values[3 * i + c]))),
    };
    let pictures = [show(&exact), show(&base), show(&head), signed(&worse, size)];
    let row: Vec<Option<&Picture>> = pictures.iter().map(Some).collect();
    let path = folder.join("triple.png");
    let png = contact_sheet(&[row]).map(|sheet| sheet.png()).unwrap_or_default();
    files::write(&path, &png)?;
    Ok(folder)
}

fn code(value: f64) -> u8 {
    (255.0 * value.clamp(0.0, 1.0)).round() as u8
}

/// White for no difference, red for worse, blue for better; the scale ends at the
/// 99th percentile.
fn signed(values: &[f64], size_px: [usize; 2]) -> Picture {
    let mut sizes: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let place = (sizes.len() * 99 / 100).min(sizes.len().saturating_sub(1));
    let most = sizes.get(place).copied().unwrap_or(0.0);
    // Where fewer than one pixel in a hundred differs, those show at full strength.
    let most = if most > 0.0 { most } else { sizes.last().copied().unwrap_or(0.0).max(1e-300) };
    Picture::from_fn(size_px, |i| {
        let share = (values[i] / most).clamp(-1.0, 1.0);
        let pale = code(1.0 - share.abs());
        if share >= 0.0 { [255, pale, pale] } else { [pale, pale, 255] }
    })
}

/// A name that any file system takes.
fn folder_name(cell: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_=.,".contains(c) { c } else { '_' };
    cell.chars().map(plain).collect()
}
