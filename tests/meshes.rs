//! Bodies from files: the same file means the same to every command, what is no
//! body is refused by all of them in the same words, and `snell mesh` mends it.
#![allow(clippy::unwrap_used, reason = "a file that cannot be used must fail its test")]

use scenes::generate::{geodesic, half_flipped};
use scenes::{LayerName, Mesh, View, obj};
use serde_json::Value;
use snell_tests::{Ran, run};
use std::path::Path;
use std::process::Command;

fn snell(folder: &Path, arguments: &[&str]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    run(command.current_dir(folder).args(arguments))
}

fn save(folder: &Path, name: &str, mesh: &Mesh) {
    let mut text = Vec::new();
    obj::write(mesh, &mut text).unwrap();
    std::fs::write(folder.join(name), text).unwrap();
}

const SCENE: &str = r#"title = "body"
[camera]
eye = [2.0, 1.5, 4.0]
target = [0.0, 0.0, 0.0]
orthographic_height_m = 3.0
resolution_px = [48, 48]
[environment]
sky = { zenith = [0.1, 0.3, 0.9], horizon = [0.9, 0.6, 0.2], ground = [0.1, 0.5, 0.1] }
[[object]]
name = "body"
shape = { obj = "body.obj" }
surface = "dielectric"
medium = { eta = 1.5 }
"#;

/// Exact exit directions of the body in a file of this text.
fn exits(text: &str) -> (Vec<u64>, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("body.obj"), text).unwrap();
    let scene = scenes::parse(SCENE, "body.toml", folder.path()).unwrap();
    let layers = vec![LayerName::Exit];
    let view = View { resolution_px: [48, 48], positions_per_axis: 1, frame: 0, layers };
    let request = reference::Request::new(view, reference::Level::R0);
    let layers = reference::render(&scene, &request).unwrap().layers;
    let exit = &layers.get(&LayerName::Exit).unwrap().data;
    assert!(exit.iter().any(|value| *value != 0.0));
    (exit.iter().map(|value| value.to_bits()).collect(), scene.warnings)
}

fn text_of(mesh: &Mesh) -> String {
    let mut text = Vec::new();
    obj::write(mesh, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

/// `vn` lines that no face uses, comments, polylines and continued lines change no bit
/// of the image; a vertex that moves does.
#[test]
fn what_says_nothing_changes_no_bit() {
    let plain = text_of(&geodesic(6));
    let (wanted, warnings) = exits(&plain);
    assert_eq!(warnings, [""; 0]);
    let first = plain.lines().find(|line| line.starts_with("f ")).unwrap();
    let (corners, last) = first.rsplit_once(' ').unwrap();
    for (changed, warned) in [
        (format!("vn 0 1 0\nvn 1 0 0\n{plain}"), 1),
        (plain.replacen(first, &format!("{corners} \\\n{last} # one"), 1), 0),
        (format!("{plain}l 1 2 3 1\np 4\n"), 0),
    ] {
        let (found, warnings) = exits(&changed);
        assert!(found == wanted);
        assert_eq!(warnings.len(), warned, "{warnings:?}");
    }
    let mut moved = geodesic(6);
    moved.positions[3] *= 0.99;
    assert!(exits(&text_of(&moved)).0 != wanted);
}

/// Bodies that no renderer can fill, each with a word of the reason, and the good one
/// that they are made of.
fn bad_bodies() -> Vec<(Mesh, &'static str)> {
    let ball = geodesic(6);
    let mut open = ball.clone();
    open.triangles.pop();
    let mut two_sided = ball.clone();
    two_sided.append(&ball.clone().reversed());
    let triangle = Mesh { triangles: vec![ball.triangles[0]], ..ball.clone() };
    vec![
        (open, "the mesh is open: 3 edges"),
        (ball.reversed(), "faces inwards"),
        (half_flipped(6), "360 of 720 triangles run the wrong way"),
        (triangle, "the mesh is open: 3 edges"),
        (two_sided, "once in each sense"),
    ]
}

#[test]
fn both_sides_refuse_what_is_no_body_in_the_same_words() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("s.toml"), SCENE).unwrap();
    let commands: [&[&str]; 4] = [
        &["plan", "s.toml", "--method", "two-interface"],
        &["plan", "s.toml", "--reference"],
        &["reference", "s.toml", "-o", "exact.exr", "--resolution", "8x8"],
        &[
            "realtime",
            "s.toml",
            "--method",
            "one-interface",
            "-o",
            "fast.exr",
            "--resolution",
            "8x8",
        ],
    ];
    save(folder, "body.obj", &geodesic(6));
    for command in commands {
        let ran = snell(folder, command);
        assert_eq!(ran.status, Some(0), "{command:?}: {}", ran.message);
    }
    for name in ["exact.exr", "fast.exr"] {
        std::fs::remove_file(folder.join(name)).unwrap();
    }
    for (mesh, word) in bad_bodies() {
        save(folder, "body.obj", &mesh);
        for command in commands {
            let ran = snell(folder, command);
            assert_eq!(ran.status, Some(2), "{word}, {command:?}: {}", ran.message);
            let (_, message) = ran.message.split_once("error: ").unwrap();
            assert!(message.starts_with("object \"body\": "), "{message}");
            assert!(message.contains(word), "{word}, {command:?}: {message}");
            assert!(message.contains("`snell mesh FILE`"), "{message}");
        }
        assert!(!folder.join("exact.exr").exists() && !folder.join("fast.exr").exists());
    }
}

fn answer(folder: &Path, arguments: &[&str]) -> Value {
    let ran = snell(folder, &[arguments, &["--json"]].concat());
    assert_eq!(ran.status, Some(0), "{arguments:?}: {}", ran.message);
    let value: Value = serde_json::from_str(&ran.answer).unwrap();
    assert_eq!(value["schema"], "snell.mesh/1");
    value
}

/// What `snell mesh` mends is a body for `snell reference` afterwards.
#[test]
fn what_is_mended_can_be_rendered() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("s.toml"), SCENE).unwrap();
    save(folder, "good.obj", &geodesic(6));
    let good = answer(folder, &["mesh", "good.obj"]);
    assert_eq!((&good["is_solid"], &good["flaw"]), (&Value::Bool(true), &Value::Null));
    assert_eq!((good["triangles"].as_u64(), good["vertices"].as_u64()), (Some(720), Some(362)));
    for (mesh, word) in bad_bodies() {
        save(folder, "bad.obj", &mesh);
        let told = answer(folder, &["mesh", "bad.obj"]);
        assert!(told["flaw"].as_str().unwrap().contains(word), "{told}");
        let told = answer(folder, &["mesh", "bad.obj", "--repair", "body.obj"]);
        // A lid over a lone triangle makes it two-sided, and no body.
        let is_lone = mesh.triangles.len() == 1;
        assert_eq!(told["repair"]["is_solid"], !is_lone, "{word}: {told}");
        let ran = snell(folder, &["reference", "s.toml", "-o", "x.exr", "--resolution", "8x8"]);
        assert_eq!(ran.status, Some(if is_lone { 2 } else { 0 }), "{word}: {}", ran.message);
    }
    // The hole is told, and left open where it is longer than what may be closed.
    let mut open = geodesic(6);
    open.triangles.pop();
    save(folder, "open.obj", &open);
    let arguments = ["mesh", "open.obj", "--repair", "left.obj", "--longest-hole", "0.1"];
    let told = answer(folder, &arguments);
    assert_eq!(told["holes"][0]["edges"], 3);
    assert_eq!(
        (&told["repair"]["holes_left"], &told["repair"]["is_solid"]),
        (&1.into(), &false.into())
    );
    let text = snell(folder, &["mesh", "open.obj"]).answer;
    assert!(text.starts_with("not a solid: the mesh is open"), "{text}");
    assert!(text.contains("3 edges") && text.contains("m around, about"), "{text}");
}

#[test]
fn mesh_refuses_what_it_cannot_use() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    save(folder, "good.obj", &geodesic(2));
    let refused = |arguments: &[&str]| {
        let ran = snell(folder, arguments);
        assert_eq!(ran.status, Some(2), "{arguments:?}: {}", ran.answer);
        ran.message
    };
    assert!(refused(&["mesh", "none.obj"]).contains("none.obj"));
    assert!(refused(&["mesh", "good.obj", "--longest-hole", "1"]).contains("--repair"));
    let error = refused(&["mesh", "good.obj", "--repair", "o.obj", "--longest-hole", "-1"]);
    assert!(error.contains("in metres"), "{error}");
    assert!(refused(&["mesh", "good.obj", "--repair", "."]).contains("cannot be written"));
}
