//! Whatever the readers of scenes, meshes and images warn of reaches people: on
//! standard error, in the answer for programs, and as an error where it is denied.
#![allow(clippy::unwrap_used, reason = "an answer that cannot be read must fail its test")]

use serde_json::{Value, json};
use snell_tests::{Ran, root, run};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// A scene without anything to warn of.
const SCENE: &str = r#"[camera]
eye = [0.0, 0.0, 4.0]
target = [0.0, 0.0, 0.0]
vertical_fov_deg = 35.0
resolution_px = [8, 8]
[environment]
radiance = [1.0, 1.0, 1.0]
[medium.glass]
eta = 1.5
[[object]]
shape = { sphere = { radius_m = 1.0 } }
surface = "dielectric"
medium = "glass"
"#;

const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn snell(folder: &Path, arguments: &[&str]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    run(command.current_dir(folder).args(arguments))
}

/// The command warns of `word` once, also in its answer, and can be denied to.
fn warns(folder: &Path, arguments: &[&str], word: &str) {
    let told = |message: &str| {
        let lines = message.lines().filter(|line| line.starts_with("warning: "));
        lines.filter(|line| line.contains(word)).count()
    };
    let ran = snell(folder, &[arguments, &["--json"]].concat());
    assert_eq!(ran.status, Some(0), "{arguments:?}: {}", ran.message);
    assert_eq!(told(&ran.message), 1, "{word} in {}", ran.message);
    for line in ran.answer.lines() {
        let object: Value = serde_json::from_str(line).unwrap();
        let warnings = object["warnings"].as_array().unwrap();
        let found = warnings.iter().filter(|text| text.as_str().unwrap().contains(word));
        assert_eq!(found.count(), 1, "{word} in {line}");
    }
    let denied = snell(folder, &[arguments, &["--deny-warnings"]].concat());
    assert_eq!((denied.status, denied.answer.as_str()), (Some(2), ""), "{arguments:?}");
    assert_eq!(told(&denied.message), 1, "{}", denied.message);
    assert!(denied.message.contains("error: --deny-warnings"), "{}", denied.message);
}

/// Plans the scene with one part replaced, beside these files.
fn scene_warns(replace: &str, by: &str, files: &[(&str, &str)], word: &str) {
    let folder = tempfile::tempdir().unwrap();
    assert!(SCENE.contains(replace), "{replace}");
    std::fs::write(folder.path().join("s.toml"), SCENE.replace(replace, by)).unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    image(&folder.path().join("odd.exr"), [6, 4], 0.5);
    image(&folder.path().join("nan.exr"), [8, 4], f64::NAN);
    warns(folder.path(), &["plan", "s.toml", "--reference"], word);
}

fn image(path: &Path, size_px: [u32; 2], first: f64) {
    let mut layers = scenes::Layers::new(size_px);
    let mut data = vec![0.5; 3 * (size_px[0] * size_px[1]) as usize];
    data[0] = first;
    layers.push(scenes::LayerName::Radiance, 3, data);
    scenes::image::write_exr(path, &layers).unwrap();
}

#[test]
fn without_doubts_nobody_is_warned() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SCENE).unwrap();
    let ran = snell(folder.path(), &["plan", "s.toml", "--reference", "--json", "--deny-warnings"]);
    assert_eq!((ran.status, ran.message.as_str()), (Some(0), ""));
    assert!(ran.answer.contains("\"warnings\":[]"), "{}", ran.answer);
}

#[test]
fn doubts_of_a_scene_file_are_told() {
    let ball = "shape = { sphere = { radius_m = 1.0 } }";
    let unused = "[medium.ice]\neta = 1.3\n[[object]]";
    let water = "[[object]]\nshape = { sphere = { radius_m = 1.0 } }\nsurface = \"dielectric\"\n\
                 medium = { eta = 1.2 }\n[[object]]";
    let light = "radiance = [1.0, 1.0, 1.0]";
    scene_warns("eta = 1.5", "eta = 5.0", &[], "no transparent medium above 4.1");
    scene_warns("eta = 1.5", "material = \"quartz\"", &[], "1.544");
    scene_warns("[[object]]", unused, &[], "medium \"ice\" is not used");
    scene_warns("[[object]]", water, &[], "may overlap at the same priority");
    scene_warns(light, "map = \"odd.exr\"", &[], "twice as wide as high");
    scene_warns(light, "map = \"nan.exr\"", &[], "1 texels were NaN");
    let normals = format!("{OBJ}vn 0 0 1\n");
    scene_warns(ball, "shape = { obj = \"a.obj\" }", &[("a.obj", &normals)], "1 normals (vn)");
    let repeated = format!("{OBJ}f 1 3 2\n");
    scene_warns(ball, "shape = { obj = \"a.obj\" }", &[("a.obj", &repeated)], "repeat others");
}

/// A glTF file with things in it that are not read.
#[test]
fn doubts_of_a_gltf_file_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut root: Value = gltf(folder.path());
    root["extensionsUsed"].as_array_mut().unwrap().push(json!("EXT_of_someone"));
    let sampler = json!({ "input": 0, "output": 0 });
    let channel = json!({ "sampler": 0, "target": { "path": "translation", "node": 0 } });
    root["animations"] = json!([{ "samplers": [sampler], "channels": [channel] }]);
    root["scenes"][0]["extras"] = json!({ "environmentMap": "nan.exr" });
    image(&folder.path().join("nan.exr"), [8, 4], f64::NAN);
    std::fs::write(folder.path().join("s.gltf"), root.to_string()).unwrap();
    for word in ["EXT_of_someone", "animations are not read", "1 texels were NaN"] {
        warns(folder.path(), &["plan", "s.gltf", "--reference"], word);
    }
}

/// A box as glTF, beside its buffers.
fn gltf(folder: &Path) -> Value {
    let ran = snell(folder, &["export", "box", "--to", "gltf", "-o", "box"]);
    assert_eq!(ran.status, Some(0), "{}", ran.message);
    for entry in std::fs::read_dir(folder.join("box")).unwrap() {
        let path = entry.unwrap().path();
        std::fs::copy(&path, folder.join(path.file_name().unwrap())).unwrap();
    }
    serde_json::from_slice(&std::fs::read(ran_file(folder)).unwrap()).unwrap()
}

fn ran_file(folder: &Path) -> std::path::PathBuf {
    let mut files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.find(|path| path.extension().is_some_and(|e| e == "gltf")).unwrap()
}

/// Each command that reads a scene or a file tells, not only plans.
#[test]
fn every_command_that_reads_tells() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SCENE.replace("1.5", "5.0")).unwrap();
    let word = "no transparent medium above 4.1";
    let floor = "[[object]]\nname = \"floor\"\nshape = { box = { half_extent_m = [4.5, 0.1, 4.5] } }\n\
                 translation_m = [0.0, -2.0, 0.0]\nsurface = \"lambert\"\nalbedo = [0.5, 0.5, 0.5]\n\
                 [[light]]\ndirectional = { direction = [0.0, -1.0, 0.0], irradiance = [1.0, 1.0, 1.0] }\n";
    let lit = format!("{}{floor}", SCENE.replace("1.5", "5.0"));
    std::fs::write(folder.path().join("lit.toml"), lit).unwrap();
    std::fs::write(folder.path().join("a.obj"), format!("{OBJ}vn 0 0 1\n")).unwrap();
    for (arguments, word) in [
        ("reference s.toml -o r.exr --resolution 4 --positions 1 --cut 0.1", word),
        ("realtime s.toml -m undeviated -o g.exr --resolution 4 --positions 1", word),
        ("plan s.toml -m undeviated", word),
        ("plan ball --reference --eta 4.5", word),
        ("caustics lit.toml --receiver floor -o c.exr --photons 100 --batches 2 --size 2", word),
        ("mesh a.obj", "1 normals (vn)"),
    ] {
        warns(folder.path(), &arguments.split(' ').collect::<Vec<_>>(), word);
    }
    let export = ["export", "s.toml", "--to", "mitsuba", "-o", "m", "--json"];
    let ran = snell(folder.path(), &export);
    assert!(ran.message.contains(word) && ran.answer.contains(word), "{}", ran.message);
}

/// The report of a study shows what is doubtful in its scenes.
#[test]
fn a_study_and_its_report_tell() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SCENE.replace("1.5", "5.0")).unwrap();
    let quick = "study s.toml -m undeviated --quick --resolution 16 --positions 1 --cut 0.1 \
                 --timing 0.01 --cache cache --json";
    let ran = snell(folder.path(), &quick.split_whitespace().collect::<Vec<_>>());
    assert_eq!(ran.status, Some(0), "{}", ran.message);
    let word = "no transparent medium above 4.1";
    let last: Value = serde_json::from_str(ran.answer.lines().last().unwrap()).unwrap();
    assert_eq!(last["schema"], "snell.study.warnings/1");
    assert!(last["warnings"][0].as_str().unwrap().contains(word), "{last}");
    for file in ["out/study.json", "out/report.html"] {
        let text = std::fs::read_to_string(folder.path().join(file)).unwrap();
        assert!(text.contains(word), "{file}");
    }
}

/// Every source file that collects warnings is one that a test above, or one
/// beside it, makes speak. Whoever adds another adds a case.
#[test]
fn no_place_that_warns_is_forgotten() {
    let known: BTreeSet<&str> = BTreeSet::from([
        "scenes/src/format/overrides.rs",
        "scenes/src/format/resolve/environment.rs",
        "scenes/src/format/resolve/media.rs",
        "scenes/src/format/resolve/mod.rs",
        "scenes/src/format/resolve/object.rs",
        "scenes/src/format/resolve/shape.rs",
        // Of images: their readers' own tests and `tests/images.rs`.
        "scenes/src/image/exr/mod.rs",
        "scenes/src/image/hdr/header.rs",
        "scenes/src/image/pfm.rs",
        "scenes/src/image/raster/mod.rs",
        "scenes/src/image/raster/other.rs",
        "scenes/src/image/raster/png.rs",
        "scenes/src/image/raster/tiff.rs",
        "scenes/src/image/read.rs",
        "scenes/src/import/extras.rs",
        "scenes/src/import/material.rs",
        "scenes/src/import/mesh.rs",
        "scenes/src/import/mod.rs",
        "scenes/src/mesh/obj/model.rs",
    ]);
    let mut found = BTreeSet::new();
    let mut folders = vec![root().join("scenes/src")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            let text: String = text.split_whitespace().collect();
            let collects = |how: &str| text.contains(&format!("warnings.{how}("));
            if ["push", "extend", "append"].into_iter().any(collects) {
                let place = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
                found.insert(place);
            }
        }
    }
    assert_eq!(found.iter().map(String::as_str).collect::<BTreeSet<_>>(), known);
}

/// Nothing of what drivers find missing is told at a success.
#[test]
fn the_driver_is_silent() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    command.arg("adapters").env_remove("XDG_RUNTIME_DIR").env_remove("NODEVICE_SELECT");
    let ran = command.output().unwrap();
    assert_eq!(String::from_utf8_lossy(&ran.stderr), "");
    assert!(ran.status.success() && !ran.stdout.is_empty());
}

/// An unwritable cache and a missing home are said, with the way out.
#[test]
fn a_cache_that_cannot_be_names_its_option() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), SCENE).unwrap();
    std::fs::write(folder.path().join("file"), "").unwrap();
    let common = "study s.toml -m undeviated --quick --resolution 8 --positions 1 --cut 0.1 \
                  --timing 0.01";
    let study = |more: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
        let arguments = format!("{common} {more}");
        command.current_dir(folder.path()).args(arguments.split_whitespace());
        for name in ["HOME", "XDG_CACHE_HOME", "LOCALAPPDATA"] {
            command.env_remove(name);
        }
        command.env("TMPDIR", folder.path());
        run(&mut command)
    };
    let unwritable = study("--cache file/below");
    assert_eq!(unwritable.status, Some(2), "{}", unwritable.message);
    assert!(unwritable.message.contains("name another folder with --cache"));
    let homeless = study("");
    assert_eq!(homeless.status, Some(0), "{}", homeless.message);
    assert!(homeless.message.contains("warning: there is no home folder"), "{}", homeless.message);
    let left: Vec<String> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| name.contains("snell"))
        .collect();
    assert_eq!(left, [""; 0]);
}
