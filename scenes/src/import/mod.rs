//! glTF 2.0 files as scenes: index, transmission, volume and dispersion as the
//! Khronos material extensions state them.
//!
//! A primitive whose material transmits becomes a solid; any other becomes a
//! Lambert surface of its base colour or, if it only glows, an unlit one. What a
//! file holds and no renderer can show (rough glass, textures, skins) is an
//! error; what the image does not depend on is a warning.

mod accessor;
pub(crate) mod error;
mod extensions;
mod extras;
mod light;
mod material;
mod mesh;
#[cfg(test)]
mod tests;

use crate::obj::Model;
use crate::scene::{Normals, Sequence, Source};
use crate::{Camera, Environment, Medium, Object, Projection, Scene, Shape};
use extras::Extras;
use glam::{DAffine3, DMat4, DVec3};
use sha2::{Digest, Sha256};
use std::path::Path;

pub use error::ImportError;

struct Reader<'a> {
    file: String,
    document: &'a gltf::Document,
    buffers: &'a [gltf::buffer::Data],
    scene: Scene,
}

/// Reads a `.gltf` or `.glb` file with the environment and the size of image
/// that its scene's extras name (as [`crate::export`] writes them); without
/// them, under `sky` at 512 x 512 pixels.
///
/// # Errors
/// As [`read`], and an environment map that cannot be read.
pub fn load(path: &Path, sky: impl FnOnce() -> Environment) -> Result<Scene, ImportError> {
    let file = File::open(path)?;
    let extras = Extras::of(&file.document, path)?;
    let sha256 = extras.sha256;
    let environment = extras.environment.unwrap_or_else(sky);
    let mut scene = file.scene(path, environment, extras.resolution_px.unwrap_or([512, 512]))?;
    scene.source.sha256.push_str(&sha256);
    scene.warnings.extend(extras.warnings);
    Ok(scene)
}

/// Reads a `.gltf` or `.glb` file under the given environment.
///
/// The first camera node becomes the camera; without one, the camera is fitted
/// to the bounds. `resolution_px` is the size of the image.
///
/// # Errors
/// If the file cannot be read, or holds what cannot be rendered: an index below
/// 1, rough or textured glass, open curves, skins, positions that are not finite.
pub fn read(
    path: &Path,
    environment: Environment,
    resolution_px: [u32; 2],
) -> Result<Scene, ImportError> {
    File::open(path)?.scene(path, environment, resolution_px)
}

/// The meshes of a file by name, as they are before nodes place them, whatever they
/// are made of.
///
/// # Errors
/// As [`read`], but for what is said of materials.
pub fn meshes(path: &Path) -> Result<Vec<(String, Model)>, ImportError> {
    let file = File::open(path)?;
    let scene = empty("", path, Environment::Uniform(DVec3::ONE));
    let reader = file.reader(path, scene);
    let mut found = Vec::new();
    for mesh in file.document.meshes() {
        for primitive in mesh.primitives() {
            let name = name_of(&mesh);
            let model = reader.mesh_of(&primitive, &name)?;
            found.push((name, model));
        }
    }
    Ok(found)
}

/// A file that has been parsed.
struct File {
    /// What its extensions call for.
    warnings: Vec<String>,
    document: gltf::Document,
    buffers: Vec<gltf::buffer::Data>,
}

impl File {
    fn open(path: &Path) -> Result<Self, ImportError> {
        let failed = |source| ImportError::File {
            file: path.display().to_string(),
            source: Box::new(source),
        };
        let io = |source| failed(gltf::Error::Io(source));
        let file = std::io::BufReader::new(std::fs::File::open(path).map_err(io)?);
        // The crate's own validation refuses extensions that are read here, and would do so
        // before anyone can say what to do about the others.
        let gltf::Gltf { document, blob } =
            gltf::Gltf::from_reader_without_validation(file).map_err(failed)?;
        let warnings = extensions::check(&document, &path.display().to_string())?;
        extensions::validate(&document).map_err(failed)?;
        let buffers = gltf::import_buffers(&document, path.parent(), blob).map_err(failed)?;
        Ok(Self { warnings, document, buffers })
    }

    fn reader(&self, path: &Path, mut scene: Scene) -> Reader<'_> {
        scene.warnings.clone_from(&self.warnings);
        let file = path.display().to_string();
        Reader { file, document: &self.document, buffers: &self.buffers, scene }
    }

    fn scene(
        &self,
        path: &Path,
        environment: Environment,
        resolution_px: [u32; 2],
    ) -> Result<Scene, ImportError> {
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let name = stem.unwrap_or_else(|| path.display().to_string());
        let mut reader = self.reader(path, empty(&name, path, environment));
        let mut camera = None;
        let scene = self.document.default_scene().or_else(|| self.document.scenes().next());
        for node in scene.iter().flat_map(gltf::Scene::nodes) {
            reader.add_node(&node, DMat4::IDENTITY, &mut camera)?;
        }
        if reader.scene.objects.is_empty() {
            return Err(reader.wrong("scene", "it holds no mesh; export it with its meshes"));
        }
        if self.document.animations().next().is_some() {
            reader.warn("animations are not read: everything rests".to_owned());
        }
        if self.document.scenes().len() > 1 {
            reader.warn("the file's other scenes are not read".to_owned());
        }
        let mut hash = Sha256::new();
        self.buffers.iter().for_each(|buffer| hash.update(&buffer.0));
        hash.update(format!("{:?}", self.document.as_json()));
        reader.scene.source.sha256 = hex(&hash.finalize());
        let bounds = reader.scene.bounds();
        reader.scene.camera = match camera {
            Some(camera) => Camera { resolution_px, ..camera },
            None => Camera::fitted(bounds, resolution_px),
        };
        Ok(reader.scene)
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn empty(name: &str, path: &Path, environment: Environment) -> Scene {
    let camera = Camera::fitted([DVec3::NEG_ONE, DVec3::ONE], [512, 512]);
    Scene {
        title: format!("{name} (glTF)"),
        source: Source { path: Some(path.to_owned()), ..Source::default() },
        environment,
        sequence: Sequence { frames: 1, seconds_per_frame: 1.0 / 60.0 },
        ..Scene::in_white_light(name, camera, vec![Medium::vacuum()], Vec::new())
    }
}

impl Reader<'_> {
    fn wrong(&self, place: &str, what: &str) -> ImportError {
        ImportError::Value {
            file: self.file.clone(),
            place: place.to_owned(),
            what: what.to_owned(),
        }
    }

    /// Tells the user something, once.
    fn warn(&mut self, what: String) {
        if !self.scene.warnings.contains(&what) {
            self.scene.warnings.push(what);
        }
    }

    fn add_node(
        &mut self,
        node: &gltf::Node<'_>,
        parent: DMat4,
        camera: &mut Option<Camera>,
    ) -> Result<(), ImportError> {
        let local = DMat4::from_cols_array_2d(&node.transform().matrix().map(|c| c.map(f64::from)));
        let world = parent * local;
        match (&camera, node.camera()) {
            (None, Some(found)) => *camera = Some(camera_of(&found, world)),
            (Some(_), Some(_)) => self.warn("cameras after the first are not read".to_owned()),
            _ => {}
        }
        self.add_light(node, world)?;
        let node_name = node.name().unwrap_or("a node without a name");
        if node.skin().is_some() {
            return Err(
                self.wrong(node_name, "skins are not rendered; apply the skin and export again")
            );
        }
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                self.add_primitive(&primitive, name_of(&mesh), world)?;
            }
        }
        node.children().try_for_each(|child| self.add_node(&child, world, camera))
    }

    fn add_primitive(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        name: String,
        world: DMat4,
    ) -> Result<(), ImportError> {
        let Model { mesh, warnings, .. } = self.mesh_of(primitive, &name)?;
        warnings.iter().for_each(|warning| self.warn(format!("{name}: {warning}")));
        if primitive.get(&gltf::Semantic::Colors(0)).is_some() {
            self.warn(format!("{name}: colours of vertices are not read"));
        }
        let normals = if mesh.normals.is_some() { Normals::Smooth } else { Normals::Flat };
        let surface = self.surface_of(&primitive.material())?;
        self.scene.objects.push(Object {
            surface,
            world_from_object: DAffine3::from_mat4(world),
            normals,
            ..Object::solid(&name, Shape::Mesh(mesh), crate::MediumId::SURROUNDINGS)
        });
        Ok(())
    }
}

fn name_of(mesh: &gltf::Mesh<'_>) -> String {
    mesh.name().map_or_else(|| format!("mesh {}", mesh.index()), str::to_owned)
}

fn camera_of(camera: &gltf::Camera<'_>, world: DMat4) -> Camera {
    let eye = world.transform_point3(DVec3::ZERO);
    let projection = match camera.projection() {
        gltf::camera::Projection::Perspective(lens) => {
            Projection::Perspective { vertical_fov_deg: f64::from(lens.yfov()).to_degrees() }
        }
        gltf::camera::Projection::Orthographic(lens) => {
            Projection::Orthographic { height_m: 2.0 * f64::from(lens.ymag()) }
        }
    };
    Camera {
        eye,
        target: eye + world.transform_vector3(DVec3::NEG_Z).normalize_or(DVec3::NEG_Z),
        up: world.transform_vector3(DVec3::Y),
        projection,
        resolution_px: [512, 512],
    }
}
