//! Every way a scene file can be wrong, and what is said about it.
#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

use super::parse;
use crate::scene::{Light, Motion, Paint};
use crate::{Environment, MediumId, Scene, Shape, Surface};
use std::path::Path;

const SCENE: &str = r#"title = "Test"
[camera]
eye = [0.0, 1.4, 4.2]
target = [0.0, 0.5, 0.0]
vertical_fov_deg = 35.0
resolution_px = [512, 512]
[environment]
radiance = [1.0, 1.0, 1.0]
[medium.glass]
eta = 1.5
[[object]]
shape = { sphere = { radius_m = 1.0 } }
surface = "dielectric"
medium = "glass"
"#;

fn read(text: &str) -> Scene {
    parse(text, "test.toml", Path::new("")).unwrap_or_else(|error| panic!("{error}"))
}

/// The message for the scene after one replacement.
fn error_of(from: &str, to: &str) -> String {
    assert_eq!(SCENE.matches(from).count(), 1, "{from}");
    let text = SCENE.replace(from, to);
    parse(&text, "test.toml", Path::new("")).map(|_| ()).unwrap_err().to_string()
}

/// Replaces part of the scene and expects an error at a place with some words.
#[track_caller]
fn refuses(from: &str, to: &str, place: &str, words: &[&str]) {
    let error = error_of(from, to);
    assert!(error.starts_with(&format!("test.toml:{place}: ")), "{error}");
    for word in words {
        assert!(error.contains(word), "{word:?} is missing in:\n{error}");
    }
}

#[test]
fn the_whole_message_shows_file_line_column_what_and_what_instead() {
    assert_eq!(
        error_of("eta = 1.5", "eta = 0.5"),
        "test.toml:10:7: refractive index 0.5 is below 1 (vacuum)\n\
         indices are absolute: an air bubble in glass is an object of medium \"vacuum\" with a \
         higher priority\n   |\n10 | eta = 0.5\n   |       ^^^"
    );
}

#[test]
fn unknown_and_missing_keys_are_errors() {
    refuses("eye =", "eyes =", "3:1", &["unknown field `eyes`", "`eye`", "`target`"]);
    refuses("eye = [0.0, 1.4, 4.2]\n", "", "2:1", &["missing field `eye`", "add it"]);
    refuses("[environment]\n", "[enviroment]\n", "7:2", &["unknown field `enviroment`"]);
    refuses("radius_m = 1.0", "radius = 1.0", "12:22", &["unknown field `radius`", "radius_m"]);
    refuses("surface = \"dielectric\"\n", "", "11:1", &["missing field `surface`"]);
}

#[test]
fn values_out_of_range_are_errors() {
    refuses("35.0", "190.0", "5:20", &["190 is not a full vertical angle"]);
    refuses("[512, 512]", "[0, 512]", "6:17", &["0 x 512", "such as [512, 512]"]);
    refuses("[512, 512]", "[100000, 100000]", "6:17", &["100000 x 100000", "16384"]);
    refuses("[0.0, 1.4, 4.2]", "[0.0, nan, 4.2]", "3:13", &["not finite"]);
    refuses("[0.0, 1.4, 4.2]", "[0.0, 4.2]", "3:7", &["three numbers such as"]);
    refuses("[0.0, 1.4, 4.2]", "\"here\"", "3:7", &["three numbers such as"]);
    refuses("radius_m = 1.0", "radius_m = -1.0", "12:33", &["-1 is not a length"]);
    refuses("eta = 1.5", "eta = inf", "10:7", &["from 1 to 1e6"]);
    refuses("eta = 1.5", "eta = \"glass\"", "10:7", &["invalid type"]);
    refuses("\"dielectric\"", "\"glassy\"", "13:11", &["`dielectric`, `unlit`, `lambert`"]);
}

#[test]
fn values_that_make_no_sense_together_are_errors() {
    let same = "target = [0.0, 1.4, 4.2]";
    refuses("target = [0.0, 0.5, 0.0]", same, "4:10", &["the same point", "move the target"]);
    let up = "vertical_fov_deg = 35.0\nup = [0.0, -0.9, -4.2]";
    refuses("vertical_fov_deg = 35.0", up, "6:6", &["along its own up", "another up"]);
    let two = "vertical_fov_deg = 35.0\northographic_height_m = 2.0";
    refuses("vertical_fov_deg = 35.0", two, "6:25", &["both given", "exactly one"]);
    refuses("vertical_fov_deg = 35.0\n", "", "2:1", &["none of vertical_fov_deg"]);
    let both = "radiance = [1.0, 1.0, 1.0]\nmap = \"a.exr\"";
    refuses("radiance = [1.0, 1.0, 1.0]", both, "9:7", &["radiance and map are both given"]);
    refuses("eta = 1.5", "eta = 1.5\nmaterial = \"ice\"", "11:12", &["eta and material"]);
    refuses("medium = \"glass\"\n", "", "11:1", &["medium is missing", "{ eta = 1.5 }"]);
    let paint = "medium = \"glass\"\nalbedo = [1.0, 1.0, 1.0]";
    refuses("medium = \"glass\"", paint, "15:10", &["albedo means nothing"]);
    let plane = "shape = { plane = {} }";
    let sphere = "shape = { sphere = { radius_m = 1.0 } }";
    refuses(sphere, plane, "12:9", &["no inside", "half_space"]);
}

#[test]
fn names_that_do_not_exist_are_errors() {
    let unknown = "medium = \"ice\"";
    refuses("medium = \"glass\"", unknown, "14:10", &["\"ice\"", "glass", "material = \"ice\""]);
    refuses("eta = 1.5", "material = \"icy\"", "10:12", &["\"icy\"", "one of vacuum, air"]);
    let sphere = "{ sphere = { radius_m = 1.0 } }";
    refuses(sphere, "\"lens\"", "12:9", &["no shape is called \"lens\"", "[shape.lens]"]);
    refuses(
        sphere,
        "{ builtin = \"rabbit\" }",
        "12:21",
        &["no built-in shape", "\"rabbit\"", "teapot"],
    );
    refuses(sphere, "{ obj = \"no.obj\" }", "12:17", &["no.obj"]);
    let map = "map = \"no.exr\"";
    refuses("radiance = [1.0, 1.0, 1.0]", map, "8:7", &["cannot read no.exr"]);
    refuses("[medium.glass]", "[medium.vacuum]", "9:1", &["vacuum is defined already"]);
}

#[test]
fn what_is_no_toml_is_an_error_with_a_place() {
    refuses("eta = 1.5", "eta = ", "10:7", &[]);
    refuses("eta = 1.5", "eta = 1.5\neta = 1.6", "11:1", &["duplicate"]);
    let empty = parse("", "empty.toml", Path::new("")).unwrap_err().to_string();
    assert!(empty.starts_with("empty.toml:1:1: missing field"), "{empty}");
}

/// A long line and characters of several bytes do not break the display.
#[test]
fn the_place_is_counted_in_characters() {
    let text = SCENE.replace("title = \"Test\"", "title = \"Prüfung — Eis\"; x");
    let error = parse(&text, "test.toml", Path::new("")).unwrap_err().to_string();
    assert!(error.starts_with("test.toml:1:24: "), "{error}");
}

#[test]
fn every_key_of_the_format_is_read() {
    let scene = read(include_str!("complete.toml"));
    assert_eq!(scene.title, "Everything at once");
    assert_eq!(scene.media[0].name, "water");
    assert_eq!(scene.objects.len(), 5);
    let ball = &scene.objects[0];
    let Surface::Dielectric { medium, priority } = ball.surface else { panic!() };
    assert_eq!((scene.media[usize::from(medium.0)].name.as_str(), priority), ("bk7", 3));
    assert!((scene.medium_of(ball).unwrap().eta.get() - 1.51680).abs() < 1e-5);
    assert!(matches!(ball.motion, Some(Motion::Spin { deg_per_s: 30.0, .. })));
    assert_eq!(ball.crack.unwrap().count, 2);
    assert_eq!(ball.air.unwrap().planes, 19);
    // A turn of 90 degrees about z takes +x to +y, after the scale.
    let x = ball.world_from_object.transform_vector3(glam::DVec3::X);
    assert!((x - glam::DVec3::new(0.0, 2.0, 0.0)).length() < 1e-15);
    assert!(std::sync::Arc::ptr_eq(&scene.objects[1].shape, &scene.objects[2].shape));
    let Surface::Unlit { radiance: Paint::Checker { size_m, .. } } = scene.objects[3].surface
    else {
        panic!()
    };
    assert_eq!(size_m, 0.25);
    assert!(matches!(*scene.objects[3].shape, Shape::HalfSpace));
    assert!(matches!(scene.lights[..], [Light::Point { .. }, Light::Directional { .. }, _]));
    assert_eq!(scene.sequence.frames, 60);
    assert_eq!(scene.judgement.flip_exposures, Some((-4.0, 2.0, 4)));
    assert!(matches!(scene.environment, Environment::Map(_)));
}

#[test]
fn doubtful_values_are_warned_about() {
    assert_eq!(read(SCENE).warnings, Vec::<String>::new());
    let warned = |from: &str, to: &str| read(&SCENE.replace(from, to)).warnings.join("\n");
    assert!(warned("eta = 1.5", "eta = 5.0").contains("index 5"));
    assert!(warned("eta = 1.5", "material = \"quartz\"").contains("1.544"));
    assert!(warned("medium = \"glass\"", "medium = \"vacuum\"").contains("\"glass\" is not used"));
    let second = "[[object]]\nshape = { sphere = { radius_m = 0.5 } }\nsurface = \"dielectric\"\n\
                  medium = { material = \"water\" }\n";
    let tie = read(&format!("{SCENE}{second}")).warnings.join("\n");
    assert!(tie.contains("may overlap at the same priority 0: \"glass\" wins"), "{tie}");
    let decided = read(&format!("{SCENE}{second}priority = 1\n"));
    assert_eq!(decided.warnings, Vec::<String>::new());
}

/// The figure in the warning is the one that decides.
#[test]
fn an_index_is_unusual_above_what_the_warning_says() {
    let warned = |eta: &str| read(&SCENE.replace("1.5", eta)).warnings.join("\n");
    assert_eq!([warned("4.05"), warned("4.1")], [""; 2]);
    assert!(warned("4.11").contains("index 4.11: no transparent medium above 4.1 "));
}

/// Whatever form a law has, its index is checked for red, green and blue.
#[test]
fn a_law_that_gives_no_index_for_a_colour_is_an_error() {
    let law = |law: &str| SCENE.replace("eta = 1.5", law);
    for sound in [
        "eta = 1.5\ndispersion = 1.0",
        // Red below 1: anomalous, and an index.
        "eta = 1.2\ndispersion = 120.0",
        "cauchy = { a = 2.6, b_um2 = -0.3 }",
    ] {
        read(&law(sound));
    }
    let refuses = |to: &str, place: &str, words: &[&str]| {
        refuses("eta = 1.5", to, place, words);
    };
    let number = "eta = 1.5\ndispersion = 300.0";
    refuses(
        number,
        "9:1",
        &["\"glass\"", "-0.757", "656.3 nm", "0.1", "write 0.25 to 1 for glass"],
    );
    refuses("material = \"diamond\"\ndispersion = 120.0", "9:1", &["656.3 nm"]);
    refuses("cauchy = { a = 0.0, b_um2 = -0.4 }", "9:1", &["the law gives", "below 1"]);
    refuses("cauchy = { a = 3.03, b_um2 = -0.7 }", "9:1", &["486.1 nm", "cauchy = {"]);
    let pole = "sellmeier = { b = [1.0, 0.0, 0.0], c_um2 = [0.3, 0.0, 0.0] }";
    refuses(pole, "9:1", &["486.1 nm", "0.0000"]);
}

#[test]
fn the_surroundings_are_medium_zero() {
    let scene = read(
        &SCENE
            .replace("[[object]]", "surroundings = 1\n[[object]]")
            .replace("surroundings = 1\n", "[surroundings]\nmedium = \"glass\"\n"),
    );
    assert_eq!(scene.media.len(), 1);
    let surface = Surface::Dielectric { medium: MediumId::SURROUNDINGS, priority: 0 };
    assert_eq!(scene.objects[0].surface, surface);
}

/// The fingerprint covers the text and the files it refers to.
#[test]
fn the_fingerprint_changes_with_a_file_that_is_referred_to() {
    let folder = tempfile::tempdir().unwrap();
    let write = |height: &str| {
        let text = format!(
            "v 0 0 0\nv 1 0 0\nv 0 {height} 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
        );
        std::fs::write(folder.path().join("body.obj"), text).unwrap();
    };
    let text = SCENE.replace("{ sphere = { radius_m = 1.0 } }", "{ obj = \"body.obj\" }");
    let mut fingerprints = Vec::new();
    for height in ["1", "1", "2"] {
        write(height);
        fingerprints.push(parse(&text, "test.toml", folder.path()).unwrap().source.sha256);
    }
    assert_eq!(fingerprints[0], fingerprints[1]);
    assert_ne!(fingerprints[1], fingerprints[2]);
}
