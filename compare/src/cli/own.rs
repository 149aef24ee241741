//! A scene around somebody's own mesh.

use crate::Error;
use glam::{DAffine3, DVec3};
use scenes::{Eta, Scene};
use std::path::{Path, PathBuf};

/// Full vertical angle of the camera, degrees.
const FIELD_OF_VIEW_DEG: f64 = 35.0;
/// Where the camera stands, seen from the middle of the body.
const TOWARDS_CAMERA: DVec3 = DVec3::new(0.35, 0.3, 1.0);
/// Share of the image's height that the bounding sphere takes.
const FILL: f64 = 0.9;

/// A mesh of one medium under a map, or under a sky, with the camera fitted to
/// its bounding sphere.
pub(super) fn scene(obj: &Path, map: Option<&Path>, eta: f64) -> Result<Scene, Error> {
    Eta::try_from(eta).map_err(|error| Error::Argument(format!("--eta {eta}: {error}")))?;
    let name = obj.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let parse = |eye: DVec3, target: DVec3| -> Result<Scene, Error> {
        let text = text(&name, obj, map, eta, [eye, target])?;
        Ok(scenes::parse(&text, &name, Path::new(""))?)
    };
    let anywhere = parse(DVec3::Z, DVec3::ZERO)?;
    let [low, high] = bounds(&anywhere);
    let (middle, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
    let distance = radius / (0.5 * FIELD_OF_VIEW_DEG).to_radians().sin() / FILL;
    parse(middle + distance * TOWARDS_CAMERA.normalize(), middle)
}

/// Corners of the box around all objects, world space, metres.
fn bounds(scene: &Scene) -> [DVec3; 2] {
    let corners = scene.objects.iter().flat_map(|object| {
        let [low, high] = object.shape.bounds();
        let world: DAffine3 = object.world_from_object;
        (0..8).map(move |corner| {
            let pick = |bit: usize, axis: usize| {
                if corner & bit == 0 { low[axis] } else { high[axis] }
            };
            world.transform_point3(DVec3::new(pick(1, 0), pick(2, 1), pick(4, 2)))
        })
    });
    corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
}

fn text(
    name: &str,
    obj: &Path,
    map: Option<&Path>,
    eta: f64,
    [eye, target]: [DVec3; 2],
) -> Result<String, Error> {
    let environment = match map {
        Some(map) => format!("map = {}", quoted(map)?),
        None => "sky = {}".to_owned(),
    };
    let name = toml::Value::from(name);
    let point = |p: DVec3| format!("[{:?}, {:?}, {:?}]", p.x, p.y, p.z);
    let (eye, target, mesh) = (point(eye), point(target), quoted(obj)?);
    Ok(format!(
        "title = {name}\n\n\
         [camera]\neye = {eye}\ntarget = {target}\n\
         vertical_fov_deg = {FIELD_OF_VIEW_DEG:?}\nresolution_px = [512, 512]\n\n\
         [environment]\n{environment}\n\n\
         [[object]]\nshape = {{ obj = {mesh} }}\nsurface = \"dielectric\"\n\
         medium = {{ eta = {eta:?} }}\n"
    ))
}

/// An absolute path as TOML text.
fn quoted(path: &Path) -> Result<String, Error> {
    let absolute: PathBuf = path.canonicalize().map_err(Error::file(path, "cannot be read"))?;
    Ok(toml::Value::from(absolute.to_string_lossy().into_owned()).to_string())
}
