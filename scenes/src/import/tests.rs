//! What is read, and what is refused with which words.
#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use super::*;
use crate::export::{Format, write};
use serde_json::{Value, json};
use std::path::PathBuf;

/// A built-in scene as a glTF file in a folder, changed by `edit`.
fn written(folder: &Path, edit: impl FnOnce(&mut Value)) -> PathBuf {
    let scene = crate::builtin("uniform-cup").unwrap();
    let main = write(&scene, Format::Gltf, &folder.join("out")).unwrap();
    let mut root: Value = serde_json::from_str(&std::fs::read_to_string(&main).unwrap()).unwrap();
    edit(&mut root);
    std::fs::write(&main, root.to_string()).unwrap();
    main
}

fn refused(edit: impl FnOnce(&mut Value)) -> String {
    let folder = tempfile::tempdir().unwrap();
    crate::find(written(folder.path(), edit).to_str().unwrap()).unwrap_err().to_string()
}

#[test]
fn extras_name_the_environment_and_the_size() {
    let folder = tempfile::tempdir().unwrap();
    let sent = crate::builtin("uniform-cup").unwrap();
    let path = written(folder.path(), |_| ());
    let back = crate::find(path.to_str().unwrap()).unwrap();
    assert_eq!(back.camera.resolution_px, sent.camera.resolution_px);
    assert!(matches!(
        (&back.environment, &sent.environment),
        (Environment::Uniform(a), Environment::Uniform(b)) if a == b
    ));
    assert_eq!(back.warnings, [""; 0]);
    let path = written(&folder.path().join("2"), |root| {
        root["scenes"][0]["extras"] = json!({ "madeBy": "someone" });
    });
    let bare = crate::find(path.to_str().unwrap()).unwrap();
    assert!(matches!(bare.environment, Environment::Map(_)));
    assert_ne!(bare.source.sha256, back.source.sha256);
}

#[test]
fn a_binary_file_is_read_like_a_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(folder.path(), |root| {
        root["buffers"][0].as_object_mut().unwrap().remove("uri");
    });
    let pad = |mut bytes: Vec<u8>, with: u8| {
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let text = pad(std::fs::read(&path).unwrap(), b' ');
    let bin = pad(std::fs::read(path.with_file_name("scene.bin")).unwrap(), 0);
    let word = |n: usize| u32::try_from(n).unwrap().to_le_bytes();
    let mut glb = [&b"glTF"[..], &word(2), &word(28 + text.len() + bin.len())].concat();
    glb.extend([&word(text.len())[..], b"JSON", &text, &word(bin.len()), b"BIN\0", &bin].concat());
    let binary = folder.path().join("scene.glb");
    std::fs::write(&binary, glb).unwrap();
    let sent = crate::builtin("uniform-cup").unwrap();
    let back = crate::find(binary.to_str().unwrap()).unwrap();
    let triangles = |scene: &Scene| scene.objects[0].shape.mesh().unwrap().triangles.len();
    assert_eq!(triangles(&back), triangles(&sent));
}

#[test]
fn what_cannot_be_rendered_is_refused_with_a_way_out() {
    let material = |change: Value| {
        move |root: &mut Value| {
            for (key, value) in change.as_object().unwrap() {
                root["materials"][0][key] = value.clone();
            }
        }
    };
    let pbr = |factors: Value| material(json!({ "pbrMetallicRoughness": factors }));
    let clear = json!({ "metallicFactor": 0.0 });
    assert!(refused(pbr(clear)).contains("write \"roughnessFactor\": 0"));
    assert!(refused(pbr(json!({ "roughnessFactor": 0.0 }))).contains("\"metallicFactor\": 0"));
    let tinted = json!({ "roughnessFactor": 0.0, "metallicFactor": 0.0,
                         "baseColorFactor": [1.0, 0.5, 0.5, 1.0] });
    assert!(refused(pbr(tinted)).contains("attenuationColor"));
    assert!(refused(material(json!({ "alphaMode": "BLEND" }))).contains("alphaMode"));
    let extension = |key: &'static str, change: Value| {
        move |root: &mut Value| root["materials"][0]["extensions"][key] = change
    };
    let half = json!({ "transmissionFactor": 0.5 });
    let error = refused(extension("KHR_materials_transmission", half));
    assert!(error.contains("neither glass nor opaque"), "{error}");
    let thin = json!({ "thicknessFactor": 0.0 });
    assert!(refused(extension("KHR_materials_volume", thin)).contains("thin wall"));
    let error = refused(extension("KHR_materials_ior", json!({ "ior": 0.7 })));
    assert!(error.contains("below 1"), "{error}");
    let error = refused(|root| {
        root["extensionsUsed"].as_array_mut().unwrap().push(json!("KHR_materials_sheen"));
    });
    assert!(error.contains("take the sheen out"), "{error}");
    let error = refused(|root| root["meshes"][0]["primitives"][0]["mode"] = json!(1));
    assert!(error.contains("export plain triangles"), "{error}");
    let error = refused(|root| root["nodes"] = json!([{ "camera": 0 }, { "name": "empty" }]));
    assert!(error.contains("holds no mesh"), "{error}");
    assert!(refused(|root| root["buffers"][0]["uri"] = json!("gone.bin")).contains("scene.gltf"));
    let error = refused(|root| {
        root["scenes"][0]["extras"] = json!({ "environmentMap": "gone.exr" });
    });
    assert!(error.contains("gone.exr"), "{error}");
    // Unread and harmless: a warning.
    let folder = tempfile::tempdir().unwrap();
    let path = written(folder.path(), |root| {
        root["extensionsUsed"].as_array_mut().unwrap().push(json!("KHR_lights_punctual"));
    });
    let scene = load(&path).unwrap();
    assert_eq!(scene.warnings, ["KHR_lights_punctual is not read"]);
}

#[test]
fn opaque_materials_are_diffuse_or_glow() {
    let surface = |change: Value| {
        let folder = tempfile::tempdir().unwrap();
        let path = written(folder.path(), |root| root["materials"][0] = change);
        load(&path).unwrap().objects[0].surface.clone()
    };
    use crate::{Surface, scene::Paint};
    let factors = json!({ "metallicFactor": 0.0, "baseColorFactor": [0.5, 0.25, 0.0, 1.0] });
    let lambert = surface(json!({ "pbrMetallicRoughness": factors }));
    let albedo = Paint::Constant(DVec3::new(0.5, 0.25, 0.0));
    assert_eq!(lambert, Surface::Lambert { albedo });
    let black = json!({ "metallicFactor": 0.0, "baseColorFactor": [0.0, 0.0, 0.0, 1.0] });
    let glow = json!({ "pbrMetallicRoughness": black, "emissiveFactor": [0.5, 1.0, 0.0] });
    let radiance = Paint::Constant(DVec3::new(0.5, 1.0, 0.0));
    assert_eq!(surface(glow), Surface::Unlit { radiance });
}
