//! Which of an OpenEXR file's layers is the image.

use super::openexr::{constants, first_pixel};
use super::*;

#[test]
fn the_only_colours_are_the_image_whatever_they_are_called() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for names in [
        ["ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"],
        ["beauty.R", "beauty.G", "beauty.B"],
        ["C.r", "C.g", "C.b"],
        ["r", "g", "b"],
        ["R", "G", "B"],
        ["red", "green", "blue"],
    ] {
        let [r, g, b] = names;
        let channels = [(r, 0.25), (g, 0.5), (b, 2.0), ("ViewLayer.Depth.Z", 9.0), ("Z", 7.0)];
        constants(&path, &channels, (3, 2));
        assert_eq!(first_pixel(&path), [0.25, 0.5, 2.0], "{names:?}");
    }
    constants(&path, &[("Y", 0.5), ("A", 1.0)], (3, 2));
    assert_eq!(first_pixel(&path), [0.5; 3]);
}

#[test]
fn where_several_layers_could_be_meant_one_is_chosen_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let colour = |layer: &str, value: f32| {
        ["R", "G", "B"].map(|component| (format!("{layer}.{component}"), value))
    };
    let all: Vec<_> = [colour("beauty", 0.5), colour("glass.direct", 0.25)].concat();
    let all: Vec<(&str, f32)> = all.iter().map(|(name, value)| (&**name, *value)).collect();
    constants(&path, &[&all[..], &[("depth.Z", 4.0)]].concat(), (2, 2));
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    for word in ["beauty", "glass.direct", "a.exr:beauty"] {
        assert!(error.contains(word), "{error}");
    }
    let layer = |name: &str| PathBuf::from(format!("{}:{name}", path.display()));
    assert_eq!(first_pixel(&layer("beauty")), [0.5; 3]);
    assert_eq!(first_pixel(&layer("glass.direct")), [0.25; 3]);
    assert_eq!(first_pixel(&layer("direct")), [0.25; 3]);
    assert_eq!(first_pixel(&layer("depth")), [4.0; 3]);
    assert_eq!(first_pixel(&layer("beauty.G")), [0.5; 3]);
    let error = open(&layer("nothing"), Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("no layer nothing") && error.contains("depth (Z)"), "{error}");
    // Blender's name for the image goes before its other passes.
    let all: Vec<_> = [colour("V.Combined", 0.5), colour("V.DiffCol", 0.25)].concat();
    let all: Vec<(&str, f32)> = all.iter().map(|(name, value)| (&**name, *value)).collect();
    constants(&path, &all, (2, 2));
    assert_eq!(first_pixel(&path), [0.5; 3]);
}
