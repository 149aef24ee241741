//! What is read, and what is refused with which words.
#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use super::*;
use crate::export::{Format, write};
use serde_json::{Value, json};
use std::path::PathBuf;

/// A built-in scene as a glTF file in a folder, changed by `edit`.
fn written(folder: &Path, edit: impl FnOnce(&mut Value)) -> PathBuf {
    let scene = crate::builtin("uniform-cup").unwrap();
    let main = write(&scene, Format::Gltf, &folder.join("out")).unwrap().file;
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
    let error = refused(extension("KHR_materials_dispersion", json!({ "dispersion": 300.0 })));
    assert!(error.contains("656.3 nm") && error.contains("write 0.25 to 1"), "{error}");
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
    let error = refused(extension("KHR_materials_ior", json!({ "ior": 0.0 })));
    assert!(error.contains("reflects everything") && error.contains("1.5"), "{error}");
    let error = refused(material(json!({ "emissiveFactor": [1.0, 1.0, 1.0] })));
    assert!(error.contains("glows"), "{error}");
}

fn warnings(edit: impl FnOnce(&mut Value)) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    load(&written(folder.path(), edit), crate::format::default_sky).unwrap().warnings
}

#[test]
fn what_is_not_read_and_harmless_is_a_warning() {
    assert_eq!(warnings(|_| ()), [""; 0]);
    let found = warnings(|root| {
        root["extensionsUsed"].as_array_mut().unwrap().push(json!("EXT_unheard_of"));
        root["nodes"].as_array_mut().unwrap().push(json!({ "camera": 0 }));
        root["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(2));
        let position = root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].clone();
        root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = position;
        let scene = root["scenes"][0].clone();
        root["scenes"].as_array_mut().unwrap().push(scene);
    });
    for word in ["EXT_unheard_of", "cameras", "colours of vertices", "other scenes"] {
        assert!(found.iter().any(|warning| warning.contains(word)), "{word}: {found:?}");
    }
    assert_eq!(found.len(), 4, "{found:?}");
}

/// The advice comes also where the file cannot be read without the extension.
#[test]
fn compressed_meshes_are_refused_with_advice_also_where_required() {
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression"] {
        for required in [false, true] {
            let error = refused(|root| {
                root["extensionsUsed"].as_array_mut().unwrap().push(json!(name));
                if required {
                    root["extensionsRequired"] = json!([name]);
                }
            });
            assert!(error.contains(name), "{error}");
            assert!(error.contains("export without mesh compression"), "{error}");
        }
    }
    let error = refused(|root| root["extensionsRequired"] = json!(["EXT_unheard_of"]));
    assert!(error.contains("EXT_unheard_of") && error.contains("export without it"), "{error}");
}

/// Bodies whose vectors are stored as whole numbers are the bodies of the floats.
#[test]
fn quantised_meshes_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let sent = Scene::in_white_light(
        "cube",
        Camera::fitted([DVec3::NEG_ONE, DVec3::ONE], [8, 8]),
        vec![Medium::vacuum(), Medium::plain("glass", crate::Eta::try_from(1.5).unwrap())],
        vec![Object::solid("cube", Shape::Mesh(crate::generate::cube(1)), crate::MediumId(1))],
    );
    let main = write(&sent, Format::Gltf, &folder.path().join("out")).unwrap().file;
    let plain = load(&main, crate::format::default_sky).unwrap();
    let mut root: Value = serde_json::from_str(&std::fs::read_to_string(&main).unwrap()).unwrap();
    let mut bytes = std::fs::read(main.with_file_name("scene.bin")).unwrap();
    let start = bytes.len();
    for index in &crate::generate::cube(1).positions {
        for value in index.to_array() {
            // -32768 and -32767 are both -1.
            let whole = if value < 0.0 { i16::MIN } else { i16::MAX };
            bytes.extend(whole.to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    std::fs::write(main.with_file_name("scene.bin"), &bytes).unwrap();
    root["buffers"][0]["byteLength"] = json!(bytes.len());
    root["bufferViews"]
        .as_array_mut()
        .unwrap()
        .push(json!({ "buffer": 0, "byteOffset": start, "byteLength": 64, "byteStride": 8 }));
    let view = root["bufferViews"].as_array().unwrap().len() - 1;
    let position = &root["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    let position = usize::try_from(position.as_u64().unwrap()).unwrap();
    for required in [false, true] {
        let accessor = &mut root["accessors"][position];
        accessor["bufferView"] = json!(view);
        accessor["componentType"] = json!(5122);
        accessor["normalized"] = json!(true);
        root["extensionsUsed"].as_array_mut().unwrap().push(json!("KHR_mesh_quantization"));
        if required {
            root["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        }
        std::fs::write(&main, root.to_string()).unwrap();
        let back = load(&main, crate::format::default_sky).unwrap();
        assert_eq!(back.objects[0].shape, plain.objects[0].shape);
        assert_eq!(back.warnings, [""; 0]);
    }
}

#[test]
fn lights_and_bright_emission_are_read() {
    use crate::{
        Surface,
        scene::{Light, Paint},
    };
    let folder = tempfile::tempdir().unwrap();
    let path = written(folder.path(), |root| {
        let black = json!({ "metallicFactor": 0.0, "baseColorFactor": [0.0, 0.0, 0.0, 1.0] });
        root["materials"][0] = json!({ "pbrMetallicRoughness": black,
            "emissiveFactor": [1.0, 0.5, 0.0],
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 10.0 } } });
        let used = root["extensionsUsed"].as_array_mut().unwrap();
        used.extend([json!("KHR_lights_punctual"), json!("KHR_materials_emissive_strength")]);
        root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
            { "type": "point", "intensity": 7.0, "color": [1.0, 0.5, 0.25] },
            { "type": "directional" }, { "type": "spot", "spot": {} }] } });
        let node = |i: u32| {
            json!({ "translation": [1.0, 2.0, 3.0],
            "extensions": { "KHR_lights_punctual": { "light": i } } })
        };
        let nodes = root["nodes"].as_array_mut().unwrap();
        let first = nodes.len();
        nodes.extend((0..3).map(node));
        let in_scene = root["scenes"][0]["nodes"].as_array_mut().unwrap();
        in_scene.extend((first..first + 3).map(|i| json!(i)));
    });
    let scene = load(&path, crate::format::default_sky).unwrap();
    let radiance = Paint::Constant(DVec3::new(10.0, 5.0, 0.0));
    assert_eq!(scene.objects[0].surface, Surface::Unlit { radiance });
    let position_m = DVec3::new(1.0, 2.0, 3.0);
    let point = Light::Point { position_m, intensity: DVec3::new(7.0, 3.5, 1.75) };
    let sun = Light::Directional { direction: DVec3::NEG_Z, irradiance: DVec3::ONE };
    assert_eq!(scene.lights, [point, sun]);
    assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
    assert!(scene.warnings[0].contains("\"spot\" are not read"), "{:?}", scene.warnings);
}

/// A normal of zero is made from the faces, and told.
#[test]
fn zero_normals_are_made_from_the_faces() {
    let folder = tempfile::tempdir().unwrap();
    let path = written(folder.path(), |_| ());
    let whole = load(&path, crate::format::default_sky).unwrap();
    let root: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let normal = &root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"];
    let accessor = &root["accessors"][usize::try_from(normal.as_u64().unwrap()).unwrap()];
    let view =
        &root["bufferViews"][usize::try_from(accessor["bufferView"].as_u64().unwrap()).unwrap()];
    let start = usize::try_from(view["byteOffset"].as_u64().unwrap()).unwrap();
    let bin = path.with_file_name("scene.bin");
    let mut bytes = std::fs::read(&bin).unwrap();
    bytes[start..start + 12].fill(0);
    std::fs::write(&bin, bytes).unwrap();
    let mended = load(&path, crate::format::default_sky).unwrap();
    assert!(mended.warnings[0].contains("zero or not a number"), "{:?}", mended.warnings);
    let normals = |scene: &Scene| {
        let normals = scene.objects[0].shape.mesh().unwrap().normals.clone().unwrap();
        normals.indices.iter().flatten().map(|i| normals.values[*i as usize]).collect::<Vec<_>>()
    };
    let (a, b) = (normals(&whole), normals(&mended));
    let moved: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a.distance(*b)).collect();
    let largest = moved.iter().copied().fold(0.0, f64::max);
    assert!(largest > 0.0 && largest < 0.8, "{largest}");
    assert!(b.iter().all(|n| (n.length() - 1.0).abs() < 1e-12));
}

#[test]
fn opaque_materials_are_diffuse_or_glow() {
    let surface = |change: Value| {
        let folder = tempfile::tempdir().unwrap();
        let path = written(folder.path(), |root| root["materials"][0] = change);
        load(&path, crate::format::default_sky).unwrap().objects[0].surface.clone()
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
