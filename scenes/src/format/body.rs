//! A scene around one mesh file: the camera sees all of it.

use super::document::EnvironmentText;
use super::{Error, parse};
use crate::environment::Map;
use crate::{Camera, Environment, Eta, Projection, Scene};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// Full vertical field of view, degrees.
const FIELD_OF_VIEW_DEG: f64 = 32.0;
/// From the body towards the camera: a little from the right and from above.
const TOWARDS_EYE: DVec3 = DVec3::new(0.35, 0.3, 1.0);
/// Room around the body's bounding sphere.
const MARGIN: f64 = 1.03;

/// The sky of built-in scenes.
const SKY: &str = "sky = { zenith = [0.16, 0.34, 0.78], horizon = [0.86, 0.90, 0.96], \
    ground = [0.10, 0.09, 0.08], sun = { direction = [0.55, 0.65, -0.52], radius_deg = 3.0, \
    radiance = [220.0, 205.0, 180.0] }, checker = { colour = [0.62, 0.56, 0.48], size = 0.7 } }";

/// The sky of built-in scenes, for scenes of other formats.
pub(crate) fn default_sky() -> Environment {
    #[expect(clippy::unwrap_used, reason = "the text is a constant")]
    let text: EnvironmentText = toml::from_str(SKY).unwrap();
    let sky = text.sky.map(|sky| sky.get_ref().sky());
    sky.map_or(Environment::Uniform(DVec3::ONE), |sky| {
        Environment::Map(Arc::new(Map::from_sky(&sky, 0.0, None)))
    })
}

impl Scene {
    /// A dielectric body from an OBJ file, under a map or, without one, under
    /// the sky of the built-in scenes; the camera is fitted to its bounds.
    ///
    /// The scene's source is the TOML text that says the same.
    ///
    /// # Errors
    /// If a file cannot be read, the index is none, or the body has no extent.
    pub fn from_obj(obj: &Path, map: Option<&Path>, eta: f64) -> Result<Self, Error> {
        let eta = Eta::try_from(eta)?;
        let name = obj.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let label = format!("scene around {}", obj.display());
        // The bounds are known once the file is read: first with any camera.
        let start = Camera {
            eye: DVec3::Z,
            target: DVec3::ZERO,
            up: DVec3::Y,
            projection: Projection::Perspective { vertical_fov_deg: FIELD_OF_VIEW_DEG },
            resolution_px: [512, 512],
        };
        let mut scene = parse(&text(&name, obj, map, eta, &start)?, &label, Path::new(""))?;
        let camera = fitted(&scene, start).ok_or_else(|| Error::Body {
            path: obj.to_owned(),
            reason: "the mesh has no extent, or one beyond 1e-9 to 1e9 metres\nuse a mesh with \
                     triangles, and scale it"
                .to_owned(),
        })?;
        scene.source.text = text(&name, obj, map, eta, &camera)?;
        scene.camera = camera;
        scene.name = name;
        Ok(scene)
    }
}

fn text(
    name: &str,
    obj: &Path,
    map: Option<&Path>,
    eta: Eta,
    camera: &Camera,
) -> Result<String, Error> {
    let environment = match map {
        Some(map) => format!("map = {}", quoted(map)?),
        None => SKY.to_owned(),
    };
    let [eye, target] = [camera.eye, camera.target].map(|p| format!("{:?}", p.to_array()));
    Ok(format!(
        "title = {title}\n\n[camera]\neye = {eye}\ntarget = {target}\n\
         vertical_fov_deg = {FIELD_OF_VIEW_DEG:?}\nresolution_px = {resolution:?}\n\n\
         [environment]\n{environment}\n\n[[object]]\nshape = {{ obj = {obj} }}\n\
         surface = \"dielectric\"\nmedium = {{ eta = {eta:?} }}\n",
        title = quoted(Path::new(name))?,
        resolution = camera.resolution_px,
        obj = quoted(obj)?,
        eta = eta.get(),
    ))
}

/// The path as a TOML string.
fn quoted(path: &Path) -> Result<String, Error> {
    let text = path.to_str().ok_or_else(|| Error::Body {
        path: path.to_owned(),
        reason: "the name is not UTF-8 and cannot stand in a scene file\nrename the file"
            .to_owned(),
    })?;
    Ok(toml::Value::from(text).to_string())
}

/// The camera from which the whole body fills the image; `None` if the body has
/// no extent.
fn fitted(scene: &Scene, camera: Camera) -> Option<Camera> {
    let [low, high] = scene.objects.first()?.shape.bounds();
    let radius = 0.5 * (high - low).length();
    if !(1e-9..=1e9).contains(&radius) {
        return None;
    }
    let target = 0.5 * (low + high);
    let distance = MARGIN * radius / (0.5 * FIELD_OF_VIEW_DEG.to_radians()).sin();
    Some(Camera { eye: target + TOWARDS_EYE.normalize() * distance, target, ..camera })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;
    use glam::DVec2;

    fn tetrahedron(folder: &Path, size: f64) -> std::path::PathBuf {
        let path = folder.join("body \"one\".obj");
        let text = format!(
            "v 3 0 0\nv {x} 0 0\nv 3 {size} 0\nv 3 0 {size}\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
            x = 3.0 + size
        );
        std::fs::write(&path, text).unwrap();
        path
    }

    /// The camera sees every vertex, the text says the same scene.
    #[test]
    fn the_whole_body_is_in_the_picture_and_the_text_says_so() {
        let folder = tempfile::tempdir().unwrap();
        for size in [1e-3, 1.0, 1e4] {
            let path = tetrahedron(folder.path(), size);
            let scene = Scene::from_obj(&path, None, 1.5).unwrap();
            let clip = scene.camera.clip_from_view(1e-3 * size, 1e3 * size)
                * scene.camera.view_from_world();
            for vertex in &scene.objects[0].shape.mesh().unwrap().positions {
                let p = clip * vertex.extend(1.0);
                assert!(DVec2::new(p.x, p.y).abs().max_element() < p.w, "{size} {vertex}");
            }
            let again = parse(&scene.source.text, "again", Path::new("")).unwrap();
            assert_eq!(again.camera, scene.camera);
        }
    }

    #[test]
    fn what_cannot_be_shown_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = tetrahedron(folder.path(), 1.0);
        let refused = |eta: f64, map: Option<&Path>| {
            Scene::from_obj(&path, map, eta).unwrap_err().to_string()
        };
        assert!(refused(0.5, None).contains("below 1"));
        assert!(refused(1.5, Some(Path::new("no.exr"))).contains("cannot read no.exr"));
        let flat = folder.path().join("flat.obj");
        std::fs::write(&flat, "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n").unwrap();
        assert!(Scene::from_obj(&flat, None, 1.5).is_err());
        assert!(Scene::from_obj(Path::new("no.obj"), None, 1.5).is_err());
    }
}
