//! glTF 2.0: index, transmission, volume, dispersion, bright emission and lights by
//! the Khronos extensions. The environment has no place in the core format; it is written
//! beside the scene as `environment.exr` and named in the scene's extras, as is
//! the size of the image.

use super::surface::{Indexed, indexed, without_bounds};
use super::{ExportError, Format, write_error, write_text};
use crate::scene::{Light, Paint};
use crate::{Environment, Medium, Object, Projection, Scene, Shape, Surface};
use glam::{DMat4, DVec3};
use serde_json::{Value, json};
use std::path::Path;

pub(super) fn write(
    scene: &Scene,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<&'static str, ExportError> {
    let mut file = File::default();
    let mut nodes = vec![camera_node(scene)];
    for object in &scene.objects {
        nodes.push(file.add(scene, object, notes)?);
    }
    nodes.extend((0..scene.lights.len()).map(|index| light_node(&scene.lights[index], index)));
    let mut root = json!({
        "asset": { "version": "2.0", "generator": "snell" },
        "extensionsUsed": ["KHR_materials_ior", "KHR_materials_transmission",
                           "KHR_materials_volume", "KHR_materials_dispersion",
                           "KHR_materials_emissive_strength"],
        "scene": 0,
        "scenes": [{ "name": scene.title, "nodes": (0..nodes.len()).collect::<Vec<_>>(),
                     "extras": extras(scene, folder)? }],
        "nodes": nodes,
        "cameras": [camera(scene)],
        "meshes": file.meshes,
        "materials": file.materials,
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{ "uri": "scene.bin", "byteLength": file.bytes.len() }],
    });
    if !scene.lights.is_empty() {
        let lights: Vec<Value> = scene.lights.iter().map(light).collect();
        root["extensions"] = json!({ LIGHTS: { "lights": lights } });
        if let Some(used) = root["extensionsUsed"].as_array_mut() {
            used.push(json!(LIGHTS));
        }
    }
    let path = folder.join("scene.bin");
    std::fs::write(&path, &file.bytes).map_err(|source| write_error(&path, source))?;
    write_text(&folder.join("scene.gltf"), &format!("{root:#}\n"))?;
    Ok("scene.gltf")
}

fn camera_node(scene: &Scene) -> Value {
    let world_from_view = scene.camera.view_from_world().inverse();
    json!({ "name": "camera", "camera": 0, "matrix": world_from_view.to_cols_array() })
}

fn camera(scene: &Scene) -> Value {
    let half = scene.camera.half_extent();
    match scene.camera.projection {
        Projection::Perspective { vertical_fov_deg } => {
            json!({ "type": "perspective", "perspective": {
            "yfov": vertical_fov_deg.to_radians(), "aspectRatio": half.x / half.y, "znear": 0.01 } })
        }
        Projection::Orthographic { .. } => json!({ "type": "orthographic", "orthographic": {
            "xmag": half.x, "ymag": half.y, "znear": 0.0, "zfar": 1000.0 } }),
    }
}

fn extras(scene: &Scene, folder: &Path) -> Result<Value, ExportError> {
    let mut extras = environment(scene, folder)?;
    extras["resolutionPx"] = json!(scene.camera.resolution_px);
    Ok(extras)
}

fn environment(scene: &Scene, folder: &Path) -> Result<Value, ExportError> {
    let map = match &scene.environment {
        Environment::Uniform(radiance) => {
            return Ok(json!({ "environmentRadiance": radiance.to_array() }));
        }
        Environment::Map(map) => map,
    };
    let path = folder.join("environment.exr");
    let [width, height] = map.lat_long.size_px.map(|n| n as usize);
    let texel = |x: usize, y: usize| <(f32, f32, f32)>::from(map.lat_long.texels[y * width + x]);
    exr::prelude::write_rgb_file(&path, width, height, texel)
        .map_err(|source| ExportError::Image { path, source })?;
    Ok(json!({ "environmentMap": "environment.exr", "environmentRotationDeg": map.rotation_deg }))
}

#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
}

impl File {
    /// Adds an object's mesh and material; returns its node.
    fn add(
        &mut self,
        scene: &Scene,
        object: &Object,
        notes: &mut Vec<String>,
    ) -> Result<Value, ExportError> {
        let material = match (scene.medium_of(object), &object.surface) {
            (Some(medium), _) => glass(medium, thickness_m(&object.shape)),
            (None, surface) => opaque(surface, object)?,
        };
        let mesh = indexed(object).ok_or_else(|| without_bounds(Format::Gltf, object))?;
        notes.extend(mesh.told.clone());
        let primitive = self.primitive(&mesh, self.materials.len());
        self.meshes.push(json!({ "name": object.name, "primitives": [primitive] }));
        self.materials.push(material);
        Ok(json!({ "name": object.name, "mesh": self.meshes.len() - 1,
                   "matrix": DMat4::from(object.world_from_object).to_cols_array() }))
    }

    fn primitive(&mut self, mesh: &Indexed, material: usize) -> Value {
        const FLOAT: u32 = 5126;
        const UNSIGNED_INT: u32 = 5125;
        let indices: Vec<u8> =
            mesh.triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
        let indices =
            self.accessor(&indices, UNSIGNED_INT, "SCALAR", 3 * mesh.triangles.len(), 34963);
        let position = self.vectors(&mesh.positions, FLOAT);
        let [low, high] = mesh
            .positions
            .iter()
            .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[l, h], p| [l.min(*p), h.max(*p)]);
        // Bounds are required for positions, of the numbers as stored.
        self.accessors[position]["min"] = json!(low.as_vec3().to_array());
        self.accessors[position]["max"] = json!(high.as_vec3().to_array());
        let mut attributes = json!({ "POSITION": position });
        if let Some(normals) = &mesh.normals {
            attributes["NORMAL"] = json!(self.vectors(normals, FLOAT));
        }
        json!({ "attributes": attributes, "indices": indices, "material": material })
    }

    fn vectors(&mut self, values: &[DVec3], kind: u32) -> usize {
        let bytes: Vec<u8> =
            values.iter().flat_map(|v| v.as_vec3().to_array()).flat_map(f32::to_le_bytes).collect();
        self.accessor(&bytes, kind, "VEC3", values.len(), 34962)
    }

    fn accessor(
        &mut self,
        bytes: &[u8],
        kind: u32,
        shape: &str,
        count: usize,
        target: u32,
    ) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(),
                                "byteLength": bytes.len(), "target": target }));
        self.bytes.extend_from_slice(bytes);
        self.accessors.push(json!({ "bufferView": self.views.len() - 1, "componentType": kind,
                                    "count": count, "type": shape }));
        self.accessors.len() - 1
    }
}

/// The volume extension's thickness is read by rasterisers only: the smallest
/// side of the bounding box.
fn thickness_m(shape: &Shape) -> f64 {
    let [low, high] = shape.bounds();
    (high - low).min_element()
}

fn glass(medium: &Medium, thickness_m: f64) -> Value {
    let mut extensions = json!({
        "KHR_materials_ior": { "ior": medium.eta.get() },
        "KHR_materials_transmission": { "transmissionFactor": 1.0 },
        "KHR_materials_volume": { "thicknessFactor": thickness_m },
    });
    // attenuationColor = exp(-absorption * attenuationDistance), at a distance where no
    // colour is near 0.
    let most = medium.absorption_per_m.max_element();
    if most > 0.0 {
        let colour = (-medium.absorption_per_m / most).exp();
        extensions["KHR_materials_volume"]["attenuationDistance"] = json!(1.0 / most);
        extensions["KHR_materials_volume"]["attenuationColor"] = json!(colour.to_array());
    }
    if medium.is_dispersive() {
        extensions["KHR_materials_dispersion"] =
            json!({ "dispersion": 20.0 / abbe_number(medium) });
    }
    json!({ "name": medium.name, "extensions": extensions, "pbrMetallicRoughness": {
        "baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.0 } })
}

/// A diffuse surface, or a black one that glows.
fn opaque(surface: &Surface, object: &Object) -> Result<Value, ExportError> {
    let base = |colour: DVec3| {
        let [r, g, b] = colour.to_array();
        json!({ "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 })
    };
    match surface {
        Surface::Lambert { albedo: Paint::Constant(albedo) } => {
            Ok(json!({ "name": object.name, "pbrMetallicRoughness": base(*albedo) }))
        }
        Surface::Unlit { radiance: Paint::Constant(radiance) } => {
            let strength = radiance.max_element().max(1.0);
            Ok(json!({ "name": object.name, "pbrMetallicRoughness": base(DVec3::ZERO),
                       "emissiveFactor": (*radiance / strength).to_array(),
                       "extensions": { "KHR_materials_emissive_strength":
                                       { "emissiveStrength": strength } } }))
        }
        _ => Err(ExportError::Inexpressible {
            format: Format::Gltf,
            what: "the checkered paint".to_owned(),
            object: object.name.clone(),
            advice: "write one colour: radiance or albedo = [r, g, b]".to_owned(),
        }),
    }
}

/// The extension that knows lights.
const LIGHTS: &str = "KHR_lights_punctual";

/// Colours are at most 1, so the rest is intensity.
fn light(light: &Light) -> Value {
    let (kind, strength) = match light {
        Light::Point { intensity, .. } => ("point", *intensity),
        Light::Directional { irradiance, .. } => ("directional", *irradiance),
    };
    let most = strength.max_element();
    let colour = if most > 0.0 { strength / most } else { DVec3::ONE };
    json!({ "type": kind, "color": colour.to_array(), "intensity": most })
}

/// A light shines along -z of its node.
fn light_node(light: &Light, index: usize) -> Value {
    let place = match light {
        Light::Point { position_m, .. } => DMat4::from_translation(*position_m),
        Light::Directional { direction, .. } => {
            DMat4::from_quat(glam::DQuat::from_rotation_arc(DVec3::NEG_Z, *direction))
        }
    };
    json!({ "name": format!("light {index}"), "matrix": place.to_cols_array(),
            "extensions": { LIGHTS: { "light": index } } })
}

/// V = (n_d - 1) / (n_F - n_C).
fn abbe_number(medium: &Medium) -> f64 {
    let [c, d, f] = crate::medium::RGB_WAVELENGTH_UM.map(|l| medium.eta_at(l));
    (d - 1.0) / (f - c)
}
