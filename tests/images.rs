//! What image files say of their pixels, as `snell compare` answers it
//! (`data/images`, made for this project).
#![allow(clippy::unwrap_used, reason = "an answer that cannot be read must fail its test")]

use serde_json::Value;
use snell_tests::{Ran, root, run};
use std::process::Command;

/// Runs `snell compare` on two files of `data/images`.
fn compare(reference: &str, test: &str, options: &[&str]) -> Ran {
    let mut command = Command::new(env!("CARGO_BIN_EXE_snell-under-test"));
    let folder = root().join("tests/data/images");
    run(command.current_dir(folder).args(["compare", "--json", reference, test]).args(options))
}

fn answer(reference: &str, test: &str, options: &[&str]) -> Vec<Value> {
    let ran = compare(reference, test, options);
    assert_eq!(ran.status, Some(0), "{reference} {test}: {}", ran.message);
    ran.answer.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn metric(answer: &[Value], name: &str) -> f64 {
    let found = answer.iter().find(|line| line["metric"] == name && line["mask"] == "all");
    found.and_then(|line| line["value"].as_f64()).unwrap_or_else(|| panic!("{name}: {answer:?}"))
}

fn are_equal(reference: &str, test: &str) -> bool {
    answer(reference, test, &[]).iter().all(|line| line["status"] == "identical")
}

/// The first line of a Radiance file is `#?` and a program's name.
#[test]
fn any_program_may_have_written_a_radiance_file() {
    assert!(are_equal("radiance.hdr", "rgbe.hdr"));
}

/// Radiance is the pixel divided by the product of all EXPOSURE lines.
#[test]
fn exposures_of_a_radiance_file_are_undone() {
    assert!(are_equal("plain.hdr", "exposed.hdr"));
    let quarter = answer("plain.hdr", "same-numbers.hdr", &[]);
    let mape = metric(&quarter, "bias") / metric(&quarter, "mae");
    assert!((mape + 1.0).abs() < 1e-12, "darker everywhere");
    assert!(!are_equal("plain.hdr", "same-numbers.hdr"));
}

/// A pixel's place is that of the data window in the display window.
#[test]
fn a_crop_stands_where_its_window_says() {
    assert!(are_equal("full.exr", "cropped.exr"));
    let moved = answer("cropped.exr", "moved.exr", &[]);
    assert!((metric(&moved, "mae") - 0.4521).abs() < 1e-4, "{}", metric(&moved, "mae"));
    assert!((metric(&moved, "max_abs") - 3.9).abs() < 1e-3, "{}", metric(&moved, "max_abs"));
}

/// Blender's name for the image is the image, alone or beside a plain one.
#[test]
fn blenders_names_are_read() {
    for pair in [["blender-ref.exr", "blender-test.exr"], ["plain-ref.exr", "blender-test.exr"]] {
        let answer = answer(pair[0], pair[1], &[]);
        assert!((metric(&answer, "mae") - 0.125).abs() < 1e-6, "{pair:?}");
    }
    let chosen = answer("blender-ref.exr:ViewLayer.Depth", "blender-test.exr:Depth", &[]);
    assert!(chosen.iter().any(|line| line["metric"] == "mae"));
    let ran = compare("blender-ref.exr:Mist", "blender-test.exr", &[]);
    assert_eq!(ran.status, Some(2));
    for word in ["no layer Mist", "ViewLayer.Combined (R,G,B)", "ViewLayer.Depth (Z)"] {
        assert!(ran.message.contains(word), "{}", ran.message);
    }
}

/// Images that differ in alpha alone are not equal; colour under alpha 0 is
/// nobody's.
#[test]
fn opacity_is_part_of_an_image() {
    let over_black = answer("opaque.png", "cut-out.png", &[]);
    assert!((metric(&over_black, "mae") - 0.5507).abs() < 1e-3, "{over_black:?}");
    assert!(over_black.iter().all(|line| line["alpha"] == "over-black"));
    assert!(metric(&over_black, "alpha_mae") > 0.5);
    assert!(are_equal("cut-out.png", "cut-out-black.png"));
    // Colours as they are stored: equal, but the images are not.
    let ignored = answer("opaque.png", "cut-out.png", &["--alpha", "ignore"]);
    assert_eq!(metric(&ignored, "mae"), 0.0);
    assert!(ignored.iter().all(|line| line["status"] != "identical"), "{ignored:?}");
    let over_white = answer("opaque.png", "cut-out.png", &["--alpha", "over-white"]);
    assert!((metric(&over_white, "mae") - 0.5507 * 55.0 / 200.0).abs() < 1e-3);
    let none = answer("plain.hdr", "exposed.hdr", &[]);
    assert!(none.iter().all(
        |line| line["alpha"] == "none" && line["warnings"] == Value::from(Vec::<Value>::new())
    ));
}

/// A linear image is encoded where that is asked for; without it the refusal
/// names the option.
#[test]
fn linear_and_display_images_meet_in_the_display() {
    let folder = tempfile::tempdir().unwrap();
    let codes = |ev: f64| -> Vec<f64> {
        let picture = scenes::image::read(&root().join("tests/data/images/full.exr")).unwrap();
        let radiance = picture.get(&scenes::LayerName::Radiance).unwrap();
        let encode = |value: &f64| {
            let shown = (value * ev.exp2()).clamp(0.0, 1.0);
            let code = if shown <= 0.003_130_8 {
                12.92 * shown
            } else {
                1.055 * shown.powf(1.0 / 2.4) - 0.055
            };
            (255.0 * code).round() / 255.0
        };
        radiance.data.iter().map(encode).collect()
    };
    let bytes: Vec<u8> = codes(-0.5).iter().map(|code| (code * 255.0).round() as u8).collect();
    let head = "P6\n32 24\n255\n".as_bytes();
    let frame = folder.path().join("frame.ppm");
    std::fs::write(&frame, [head, &bytes].concat()).unwrap();
    let frame = frame.to_str().unwrap();
    let right = answer("full.exr", frame, &["--display", "ev=-0.5"]);
    assert!(metric(&right, "max_abs") <= 0.5 / 255.0 + 1e-9, "{right:?}");
    assert!(right.iter().any(|line| line["metric"].as_str().unwrap().starts_with("flip")));
    let wrong = answer("full.exr", frame, &["--display", "ev=0.5"]);
    assert!(metric(&wrong, "mae") > 10.0 * metric(&right, "mae"));
    for (reference, options, word) in [
        ("full.exr", &[][..], "--display ev=0"),
        (frame, &["--display", "ev=0"], "leave it out"),
        ("full.exr", &["--display", "0.5"], "write ev=STOPS"),
        ("full.exr", &["--display", "ev=0", "--flip-exposures", "-1,1,3"], "--flip-exposures"),
    ] {
        let ran = compare(reference, frame, options);
        assert_eq!(ran.status, Some(2), "{options:?}: {}", ran.answer);
        assert!(ran.message.contains(word), "{}", ran.message);
    }
}
