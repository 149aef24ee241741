//! glTF 2.0 files as scenes: index, transmission, volume and dispersion as the
//! Khronos material extensions state them.
//!
//! A primitive whose material transmits becomes a solid; any other becomes a
//! Lambert surface of its base colour. Textures, animation and skins are not read.

use crate::scene::{Judgement, Normals, Paint, Sequence, Source};
use crate::{
    Camera, Dispersion, Environment, Eta, Medium, MediumId, Mesh, Object, Projection, Scene,
};
use crate::{Shape, Surface, mesh::CornerNormals};
use glam::{DAffine3, DMat4, DVec3};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

/// Why a glTF file is not a scene.
#[derive(Debug, thiserror::Error)]
pub enum ImportError {
    /// The file or one of its buffers is missing or damaged.
    #[error("{file}: {source}")]
    File {
        /// As given.
        file: String,
        /// What the reader said.
        source: Box<gltf::Error>,
    },
    /// A value that no renderer can use.
    #[error("{file}, {place}: {what}")]
    Value {
        /// As given.
        file: String,
        /// Mesh or material.
        place: String,
        /// What is wrong and what to write instead.
        what: String,
    },
}

struct Reader<'a> {
    file: String,
    buffers: &'a [gltf::buffer::Data],
    scene: Scene,
}

/// Reads a `.gltf` or `.glb` file under the given environment.
///
/// The first camera node becomes the camera; without one, the camera is fitted
/// to the bounds. `resolution_px` is the size of the image.
///
/// # Errors
/// If the file cannot be read, an index is below 1, or a position is not finite.
pub fn read(
    path: &Path,
    environment: Environment,
    resolution_px: [u32; 2],
) -> Result<Scene, ImportError> {
    let file = path.display().to_string();
    let failed = |source| ImportError::File { file: file.clone(), source: Box::new(source) };
    let gltf::Gltf { document, blob } = gltf::Gltf::open(path).map_err(failed)?;
    let buffers = gltf::import_buffers(&document, path.parent(), blob).map_err(failed)?;
    let name =
        path.file_stem().map_or_else(|| file.clone(), |stem| stem.to_string_lossy().into_owned());
    let mut reader = Reader { file, buffers: &buffers, scene: empty(&name, path, environment) };
    let mut camera = None;
    let scene = document.default_scene().or_else(|| document.scenes().next());
    for node in scene.iter().flat_map(gltf::Scene::nodes) {
        reader.add_node(&node, DMat4::IDENTITY, &mut camera)?;
    }
    let mut hash = Sha256::new();
    buffers.iter().for_each(|buffer| hash.update(&buffer.0));
    hash.update(format!("{:?}", document.as_json()));
    reader.scene.source.sha256 = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    let bounds = reader.scene.bounds();
    reader.scene.camera = match camera {
        Some(camera) => Camera { resolution_px, ..camera },
        None => Camera::fitted(bounds, resolution_px),
    };
    Ok(reader.scene)
}

fn empty(name: &str, path: &Path, environment: Environment) -> Scene {
    Scene {
        name: name.to_owned(),
        title: format!("{name} (glTF)"),
        source: Source { path: Some(path.to_owned()), ..Source::default() },
        camera: Camera::fitted([DVec3::NEG_ONE, DVec3::ONE], [512, 512]),
        environment,
        media: vec![Medium::vacuum()],
        objects: Vec::new(),
        lights: Vec::new(),
        sequence: Sequence { frames: 1, seconds_per_frame: 1.0 / 60.0 },
        judgement: Judgement::default(),
        warnings: Vec::new(),
    }
}

impl Reader<'_> {
    fn add_node(
        &mut self,
        node: &gltf::Node<'_>,
        parent: DMat4,
        camera: &mut Option<Camera>,
    ) -> Result<(), ImportError> {
        let local = DMat4::from_cols_array_2d(&node.transform().matrix().map(|c| c.map(f64::from)));
        let world = parent * local;
        if let (None, Some(found)) = (&camera, node.camera()) {
            *camera = Some(camera_of(&found, world));
        }
        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                let name =
                    mesh.name().map_or_else(|| format!("mesh {}", mesh.index()), str::to_owned);
                self.add_primitive(&primitive, name, world)?;
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
        if primitive.mode() != gltf::mesh::Mode::Triangles {
            self.scene.warnings.push(format!("{name}: points, lines and strips are not drawn"));
            return Ok(());
        }
        let mesh = self.mesh_of(primitive, &name)?;
        let normals = if mesh.normals.is_some() { Normals::Smooth } else { Normals::Flat };
        let surface = self.surface_of(&primitive.material())?;
        self.scene.objects.push(Object {
            name,
            shape: Arc::new(Shape::Mesh(mesh)),
            surface,
            world_from_object: DAffine3::from_mat4(world),
            normals,
            motion: None,
            deform: None,
            bump: None,
            crack: None,
            air: None,
        });
        Ok(())
    }

    fn mesh_of(&self, primitive: &gltf::Primitive<'_>, name: &str) -> Result<Mesh, ImportError> {
        let wrong = |what: &str| ImportError::Value {
            file: self.file.clone(),
            place: name.to_owned(),
            what: what.to_owned(),
        };
        let reader =
            primitive.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data.0[..]));
        let vector = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        let corners: Vec<DVec3> = reader
            .read_positions()
            .ok_or_else(|| wrong("has no POSITION; export it with positions"))?
            .map(vector)
            .collect();
        if !corners.iter().all(|p| p.is_finite()) {
            return Err(wrong("a position is not finite; repair the mesh"));
        }
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..corners.len() as u32).collect(),
        };
        if indices.iter().any(|index| *index as usize >= corners.len()) {
            return Err(wrong("an index points beyond the last vertex; repair the mesh"));
        }
        let triangles: Vec<[u32; 3]> =
            indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let normals = reader.read_normals().map(|normals| CornerNormals {
            values: normals.map(|n| vector(n).normalize_or(DVec3::Y)).collect(),
            indices: triangles.clone(),
        });
        if normals.as_ref().is_some_and(|normals| normals.values.len() != corners.len()) {
            return Err(wrong("NORMAL and POSITION differ in length; repair the mesh"));
        }
        Ok(welded(&corners, &triangles, normals))
    }

    fn surface_of(&mut self, material: &gltf::Material<'_>) -> Result<Surface, ImportError> {
        let transmits = material.transmission().is_some_and(|t| t.transmission_factor() > 0.0);
        if !transmits {
            let [r, g, b, _] = material.pbr_metallic_roughness().base_color_factor().map(f64::from);
            return Ok(Surface::Lambert { albedo: Paint::Constant(DVec3::new(r, g, b)) });
        }
        let medium = self.medium_of(material)?;
        if material.pbr_metallic_roughness().roughness_factor() > 0.0 {
            self.scene
                .warnings
                .push(format!("{}: roughness is ignored: all interfaces are smooth", medium.name));
        }
        let known = self.scene.media.iter().position(|other| *other == medium);
        let index = known.unwrap_or(self.scene.media.len());
        if known.is_none() {
            self.scene.media.push(medium);
        }
        Ok(Surface::Dielectric { medium: MediumId(index as u16), priority: 0 })
    }

    fn medium_of(&self, material: &gltf::Material<'_>) -> Result<Medium, ImportError> {
        let name = material.name().unwrap_or("glass").to_owned();
        let eta = Eta::try_from(f64::from(material.ior().unwrap_or(1.5))).map_err(|error| {
            ImportError::Value {
                file: self.file.clone(),
                place: name.clone(),
                what: error.to_string(),
            }
        })?;
        let mut medium = Medium::plain(&name, eta);
        if let Some(volume) = material.volume() {
            let colour = DVec3::from_array(volume.attenuation_color().map(f64::from));
            let distance_m = f64::from(volume.attenuation_distance());
            if distance_m.is_finite() && distance_m > 0.0 {
                medium.absorption_per_m = -colour.max(DVec3::splat(1e-30)).ln() / distance_m;
            }
        }
        let dispersion = material
            .extension_value("KHR_materials_dispersion")
            .and_then(|value| value.get("dispersion")?.as_f64());
        if let Some(dispersion) = dispersion.filter(|value| *value > 0.0) {
            medium.dispersion = Dispersion::Gltf { dispersion };
        }
        Ok(medium)
    }
}

/// One position per distinct point, so that shared edges share indices.
fn welded(corners: &[DVec3], triangles: &[[u32; 3]], normals: Option<CornerNormals>) -> Mesh {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
    let mut positions = Vec::new();
    let number: Vec<u32> = corners
        .iter()
        .map(|p| {
            // Adding zero makes -0 and +0 the same bits.
            let bits = (*p + DVec3::ZERO).to_array().map(f64::to_bits);
            *numbers.entry(bits).or_insert_with(|| {
                positions.push(*p);
                (positions.len() - 1) as u32
            })
        })
        .collect();
    let triangles = triangles.iter().map(|t| t.map(|i| number[i as usize])).collect();
    Mesh { positions, triangles, normals }
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
