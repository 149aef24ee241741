//! The folder of a report, beside the page: pictures in full size, contact sheets,
//! plots.

use super::ReportError;
use super::page::{SceneView, Shown};
use super::pictures::{MethodPictures, Picture, ScenePictures, contact_sheet};
use crate::report::plot::literal;
use crate::support::files;
use std::path::Path;

/// Widest picture in the page, pixels: larger ones are shrunk there.
const SHOWN_WIDTH_PX: usize = 320;

/// Puts small pictures into the page, and full ones, the contact sheet and the
/// plots into files below `directory`.
pub(super) fn place(
    directory: &Path,
    scene: &mut SceneView,
    pictures: Option<ScenePictures>,
) -> Result<(), ReportError> {
    let name = file_name(&scene.entry.name);
    for plot in &scene.plots {
        let path = directory.join("plots").join(format!("{name}-{}.svg", plot.kind));
        files::write(&path, literal(&plot.svg).as_bytes())?;
        scene.files.push(path);
    }
    let Some(pictures) = pictures else { return Ok(()) };
    for (path, picture) in named(&name, scene, &pictures) {
        let path = directory.join("pictures").join(path);
        files::write(&path, &picture.png())?;
        scene.files.push(path);
    }
    if let Some(sheet) = sheet(&pictures) {
        let path = directory.join("pictures").join(format!("{name}.png"));
        files::write(&path, &sheet.png())?;
        scene.files.push(path);
    }
    scene.reference = Some(shown(&pictures.exact));
    for (method, pictures) in scene.methods.iter_mut().zip(&pictures.methods) {
        method.pictures = pictures.as_ref().map(|p| MethodPictures {
            image: shown(&p.image),
            flip: p.flip.as_ref().map(shown),
            angle: p.angle.as_ref().map(shown),
        });
    }
    Ok(())
}

/// A picture as it stands in the page.
fn shown(picture: &Picture) -> Shown {
    let small = picture.shrunk_to(SHOWN_WIDTH_PX);
    let data_uri = format!("data:image/png;base64,{}", super::viewer::block::base64(&small.png()));
    Shown { size_px: small.size_px, data_uri }
}

/// Every picture with its file name.
fn named<'a>(
    scene_name: &str,
    scene: &SceneView,
    pictures: &'a ScenePictures,
) -> Vec<(String, &'a Picture)> {
    let mut list = vec![(format!("{scene_name}-exact.png"), &pictures.exact)];
    for (method, pictures) in scene.methods.iter().zip(&pictures.methods) {
        let Some(pictures) = pictures else { continue };
        let name = format!("{scene_name}-{}", file_name(&method.name));
        let maps = [("-flip", &pictures.flip), ("-angle", &pictures.angle)];
        list.push((format!("{name}.png"), &pictures.image));
        list.extend(
            maps.into_iter().filter_map(|(kind, map)| {
                map.as_ref().map(|map| (format!("{name}{kind}.png"), map))
            }),
        );
    }
    list
}

/// One row per method: exact | approximate | FLIP | exit angle.
fn sheet(pictures: &ScenePictures) -> Option<Picture> {
    let rows: Vec<Vec<Option<&Picture>>> = pictures
        .methods
        .iter()
        .flatten()
        .map(|p| vec![Some(&pictures.exact), Some(&p.image), p.flip.as_ref(), p.angle.as_ref()])
        .collect();
    contact_sheet(&rows)
}

/// A name that is safe as a file name everywhere.
fn file_name(name: &str) -> String {
    let safe = |c: char| if c.is_ascii_alphanumeric() || "-_.=".contains(c) { c } else { '_' };
    name.chars().map(safe).collect::<String>().trim_start_matches('.').to_owned()
}
