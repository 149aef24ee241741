//! Bad input gets one clear message, exit status 2, and nothing is written.
#![allow(clippy::unwrap_used, reason = "a folder that cannot be made must fail its test")]

use snell_tests::{root, run};
use std::path::Path;
use std::process::Command;

/// Runs `snell` in an empty folder and expects it to refuse with all of `words`.
fn refuses(folder: &Path, arguments: &[&str], words: &[&str]) {
    let before = files(folder);
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    let ran = run(command.current_dir(folder).args(arguments));
    assert_eq!(ran.status, Some(2), "{arguments:?}: {}{}", ran.answer, ran.message);
    for word in words {
        assert!(ran.message.contains(word), "`{word}` is not in: {}", ran.message);
    }
    assert_eq!(ran.message.matches("error:").count(), 1, "{}", ran.message);
    assert!(!ran.message.contains("panicked"), "{}", ran.message);
    assert_eq!(files(folder), before, "{arguments:?} left something behind");
}

/// Names of everything in a folder.
fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn images_to_compare_must_exist_and_hold_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let data = root().join("tests/data/vectors").canonicalize().unwrap();
    let image = |name: &str| data.join(name).to_string_lossy().into_owned();
    refuses(folder.path(), &["compare", "a.exr", "b.exr"], &["a.exr", "No such file"]);
    let (reference, nan) =
        (image("degenerate/nan_in_test_ref.exr"), image("degenerate/nan_in_test_test.exr"));
    refuses(folder.path(), &["compare", &reference, &nan], &["nan_in_test_test.exr", "NaN"]);
    let other = image("images/hdr_glass_ref.exr");
    refuses(folder.path(), &["compare", &reference, &other], &["192x128", "one resolution"]);
    std::fs::write(folder.path().join("cut.exr"), &std::fs::read(&other).unwrap()[..900]).unwrap();
    refuses(folder.path(), &["compare", &other, "cut.exr"], &["cut.exr"]);
}

/// A scene that is right, with one part replaced.
fn scene(replace: &str, by: &str) -> String {
    let text = r#"title = "Test"
[camera]
eye = [0.0, 0.0, 4.0]
target = [0.0, 0.0, 0.0]
vertical_fov_deg = 35.0
resolution_px = [16, 16]
[environment]
radiance = [1.0, 1.0, 1.0]
[[object]]
shape = { sphere = { radius_m = 1.0 } }
surface = "dielectric"
medium = { eta = 1.5 }
"#;
    assert!(text.contains(replace), "{replace}");
    text.replace(replace, by)
}

/// Writes the scene into an empty folder and expects every command that reads
/// scenes to refuse it.
fn refuses_scene(replace: &str, by: &str, files: &[(&str, &[u8])], words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), scene(replace, by)).unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    refuses(folder.path(), &["reference", "s.toml", "-o", "out/x.exr"], words);
    refuses(folder.path(), &["study", "s.toml", "-o", "out", "--cache", "cache"], words);
}

#[test]
fn the_scene_that_the_others_are_made_of_is_right() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), scene("Test", "Test")).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    command.current_dir(folder.path()).args(["reference", "s.toml", "-o", "out/x.exr"]);
    assert_eq!(run(&mut command).status, Some(0));
    assert_eq!(files(&folder.path().join("out")), ["x.exr"]);
}

#[test]
fn scenes_and_what_they_refer_to_must_exist() {
    let folder = tempfile::tempdir().unwrap();
    refuses(folder.path(), &["study", "nowhere.toml"], &["nowhere.toml", "No such file"]);
    refuses(folder.path(), &["study", "tea-pot"], &["tea-pot", "teapot"]);
    refuses(folder.path(), &["study", "--obj", "my.obj"], &["my.obj", "No such file"]);
    let sphere = "{ sphere = { radius_m = 1.0 } }";
    refuses_scene(sphere, "{ obj = \"a.obj\" }", &[], &["s.toml:10:", "a.obj"]);
}

#[test]
fn an_index_below_vacuum_gets_the_bubble_hint() {
    refuses_scene("eta = 1.5", "eta = 0.5", &[], &["s.toml:12:", "0.5", "below 1", "bubble"]);
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["study", "--obj", "a.obj", "--eta", "0.5"];
    refuses(folder.path(), &arguments, &["0.5", "below 1"]);
}

#[test]
fn an_unknown_key_is_named_with_its_place() {
    refuses_scene("title =", "titel =", &[], &["s.toml:1:1", "titel"]);
}

#[test]
fn an_eye_in_its_target_sees_nothing() {
    refuses_scene("eye = [0.0, 0.0, 4.0]", "eye = [0.0, 0.0, 0.0]", &[], &["s.toml:", "eye"]);
}

#[test]
fn an_absurd_resolution_is_refused() {
    refuses_scene("[16, 16]", "[1000000, 1000000]", &[], &["s.toml:6:"]);
    refuses_scene("[16, 16]", "[0, 16]", &[], &["s.toml:6:"]);
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["reference", "ball", "-o", "x.exr", "--resolution", "0x5"];
    refuses(folder.path(), &arguments, &["0x5", "512x512"]);
}

#[test]
fn a_mesh_with_a_bad_index_or_nan_is_refused() {
    let sphere = "{ sphere = { radius_m = 1.0 } }";
    let obj = "{ obj = \"a.obj\" }";
    let bad_index = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n";
    refuses_scene(sphere, obj, &[("a.obj", bad_index)], &["a.obj"]);
    let nan = b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n";
    refuses_scene(sphere, obj, &[("a.obj", nan)], &["a.obj"]);
    let open = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    refuses_scene(sphere, obj, &[("a.obj", open)], &["open"]);
}

#[test]
fn a_map_that_is_cut_off_or_empty_is_refused() {
    let image = root().join("tests/data/vectors/images/hdr_glass_ref.exr");
    let whole = std::fs::read(image).unwrap();
    let (radiance, map) = ("radiance = [1.0, 1.0, 1.0]", "map = \"a.exr\"");
    refuses_scene(radiance, map, &[("a.exr", &whole[..whole.len() / 2])], &["s.toml:8:", "a.exr"]);
    refuses_scene(radiance, map, &[("a.exr", b"")], &["s.toml:8:", "a.exr"]);
    let empty = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n";
    refuses_scene(radiance, "map = \"a.hdr\"", &[("a.hdr", empty)], &["s.toml:8:", "a.hdr"]);
}

#[test]
fn without_an_adapter_nothing_is_started() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        &["study", "ball"][..],
        &["adapters"],
        &["realtime", "ball", "-m", "undeviated", "-o", "x.exr"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
        command.current_dir(folder.path()).args(arguments);
        // The loader is shown a driver list that is not there.
        for name in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
            command.env(name, "/nonexistent");
        }
        let ran = run(&mut command);
        assert_eq!(ran.status, Some(2), "{arguments:?}: {}", ran.message);
        assert!(ran.message.contains("adapter"), "{}", ran.message);
        assert!(ran.message.contains("mesa-vulkan-drivers"), "{}", ran.message);
        assert_eq!(files(folder.path()), [""; 0]);
    }
}

#[test]
fn unknown_methods_and_parameters_name_the_known_ones() {
    let folder = tempfile::tempdir().unwrap();
    let study = ["study", "ball", "--method", "magic", "--cache", "cache"];
    refuses(folder.path(), &study, &["magic", "blended"]);
    let wrong = ["realtime", "ball", "-m", "blended", "--param", "b=1", "-o", "x.exr"];
    refuses(folder.path(), &wrong, &["blended", "\"b\""]);
    let range = ["plan", "ball", "-m", "blended", "--param", "a=seven"];
    refuses(folder.path(), &range, &["blended", "seven"]);
}
