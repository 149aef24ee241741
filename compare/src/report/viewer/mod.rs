//! HDR data for the viewer in the page, within a budget.

pub mod block;

use super::page::{ImageData, SceneData, SceneView};
use super::pictures::{SceneImages, colour_map};
use super::runs::{MERITS, methods_of};
use crate::results::Study;
use crate::support::files::{self, FileError};
use serde_json::json;
use std::path::Path;

/// Base64 bytes per half float, as measured on glass under a sky.
const BYTES_PER_VALUE: f64 = 1.6;

/// By how much pictures are shrunk in both directions, so that the data of
/// the whole study stay within the budget.
pub(in crate::report) fn shrinking(study: &Study, budget_bytes: f64) -> usize {
    let values: u64 = study
        .scenes
        .iter()
        .map(|scene| {
            let [width, height] = scene.resolution_px.map(u64::from);
            // Three channels of radiance, one of FLIP, one of the angle.
            width * height * (3 + 5 * methods_of(study, &scene.name).len() as u64)
        })
        .sum();
    (values as f64 * BYTES_PER_VALUE / budget_bytes).sqrt().ceil().max(1.0) as usize
}

/// What was done to keep the page small; empty if nothing.
pub(in crate::report) fn note(factor: usize, single_file: bool) -> String {
    if factor == 1 {
        return String::new();
    }
    let full = if single_file {
        "the EXR files of the study hold them all"
    } else {
        "all of them are in data/ beside it, and are shown while that folder is there"
    };
    format!("To keep this file small it holds means of {factor}x{factor} pixels; {full}.")
}

/// Where a scene's data in full size lie, from the page.
fn script_place(index: usize) -> String {
    format!("data/scene-{index}.js")
}

/// Writes a scene's data in full size as a script that the page runs when the scene is
/// looked at: a page that is opened from a file may load nothing else.
pub(in crate::report) fn write_full(
    directory: &Path,
    view: &SceneView,
    images: &SceneImages,
) -> Result<(), FileError> {
    let Some(data) = data(view, images, 1) else { return Ok(()) };
    let blocks: serde_json::Map<String, serde_json::Value> =
        data.blocks(view.index).map(|(name, text)| (name, text.into())).collect();
    let script = format!("snellScene({}, {});\n", view.index, serde_json::Value::Object(blocks));
    files::write(&directory.join(script_place(view.index)), script.as_bytes())
}

/// The viewer's table of contents as JSON that is safe inside a script
/// element; empty when there is nothing to view.
pub(in crate::report) fn contents(scenes: &[SceneView], factor: usize, full: bool) -> String {
    let entry = |(view, data): (&SceneView, &SceneData)| {
        let names: Vec<&str> = data.images.iter().map(|image| image.name.as_str()).collect();
        json!({
            "index": view.index,
            "name": view.entry.name,
            "width": data.file_px[0],
            "height": data.file_px[1],
            "texel_px": factor,
            "file": full.then(|| script_place(view.index)),
            "ev": view.ev,
            "images": names,
            "facts": facts(view, &names),
            // The image beside the exact one at first: the best by exit angle.
            "best": best(view, &names),
        })
    };
    let list: Vec<_> =
        scenes.iter().filter_map(|view| Some((view, view.data.as_ref()?))).map(entry).collect();
    if list.is_empty() {
        return String::new();
    }
    let text = json!({ "scenes": list, "ramps": ramps() }).to_string();
    text.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// Place of the best method among the images; the last one if none is best.
fn best(view: &SceneView, names: &[&str]) -> usize {
    let best = view.methods.iter().find(|m| m.cells.first().is_some_and(|cell| cell.best));
    let place = best.and_then(|method| names.iter().position(|name| *name == method.name));
    place.unwrap_or(names.len() - 1)
}

/// Names and values of the verdict for each image; none for the exact one.
fn facts(view: &SceneView, names: &[&str]) -> Vec<Vec<(String, String)>> {
    let of_image = |name: &&str| {
        let Some(method) = view.methods.iter().find(|method| method.name == **name) else {
            return Vec::new();
        };
        let columns = MERITS
            .iter()
            .zip(&method.cells)
            .map(|((_, head, unit), cell)| (head.to_string(), format!("{} {unit}", cell.text)));
        let cost = [("frame", &method.time.text), ("memory", &method.memory)];
        columns.chain(cost.map(|(name, text)| (name.to_owned(), text.clone()))).collect()
    };
    names.iter().map(of_image).collect()
}

/// The two colour tables: even ramp, FLIP; 256 colours each, base64.
fn ramps() -> String {
    let share = |i: u32| f64::from(i) / 255.0;
    let even = (0..256).map(|i| colour_map::ramp(share(i)));
    let flip = (0..256).map(|i| colour_map::flip(share(i)));
    let bytes: Vec<u8> = even.chain(flip).flatten().collect();
    block::base64(&bytes)
}

/// HDR data of a scene, shrunk by a factor.
pub(in crate::report) fn data(
    view: &SceneView,
    images: &SceneImages,
    factor: usize,
) -> Option<SceneData> {
    let reference = images.reference.as_ref()?;
    let [width, height] = images.size_px;
    let size_px = [width.div_ceil(factor), height.div_ceil(factor)];
    let coded = |values: &[f64], channels: usize| {
        let small = shrink(values, channels, images.size_px, factor);
        block::encode(&small, channels, size_px[0])
    };
    let mut list = vec![ImageData {
        name: "exact".to_owned(),
        radiance: coded(reference, 3),
        ..ImageData::default()
    }];
    for (method, image) in view.methods.iter().zip(&images.methods) {
        let Some(image) = image else { continue };
        let angles: Option<Vec<f64>> = image.angle_deg.as_ref().map(|map| {
            map.iter().map(|&degrees| if degrees.is_nan() { -1.0 } else { degrees }).collect()
        });
        list.push(ImageData {
            name: method.name.clone(),
            radiance: coded(&image.radiance, 3),
            flip: image.flip.as_ref().map(|map| coded(map, 1)).unwrap_or_default(),
            angle: angles.map(|map| coded(&map, 1)).unwrap_or_default(),
        });
    }
    Some(SceneData { file_px: images.size_px, images: list })
}

/// Means of blocks of `factor` x `factor` pixels.
fn shrink(values: &[f64], channels: usize, [width, height]: [usize; 2], factor: usize) -> Vec<f64> {
    if factor == 1 {
        return values.to_vec();
    }
    let small = [width.div_ceil(factor), height.div_ceil(factor)];
    let mut means = Vec::with_capacity(small[0] * small[1] * channels);
    for i in 0..small[0] * small[1] {
        let (x0, y0) = (i % small[0] * factor, i / small[0] * factor);
        for channel in 0..channels {
            let (mut sum, mut count) = (0.0, 0.0);
            for y in y0..(y0 + factor).min(height) {
                for x in x0..(x0 + factor).min(width) {
                    sum += values[(y * width + x) * channels + channel];
                    count += 1.0;
                }
            }
            means.push(sum / count);
        }
    }
    means
}
