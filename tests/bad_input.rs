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
