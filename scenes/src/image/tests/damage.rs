//! Damaged files of every kind and codec: an error or an image, never a panic.

use super::*;

/// Overwrites every so many bytes of a file, one at a time, and cuts it off there.
fn damage(name: &str, bytes: &[u8], places: usize) {
    let read = |bytes: &[u8]| {
        let wanted = crate::image::exr::Wanted::Image(None);
        let _ = read::picture_of(Path::new(name), bytes, wanted, Alpha::default());
    };
    let mut damaged = bytes.to_vec();
    for place in 0..places {
        let at = place * bytes.len() / places;
        for value in [0x00, 0x7f, 0xff] {
            damaged[at] = value;
            read(&damaged);
        }
        damaged[at] = bytes[at];
        read(&bytes[..at]);
    }
}

#[test]
fn damaged_openexr_files_do_no_harm() {
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/exr");
    let mut count = 0;
    for entry in std::fs::read_dir(files).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "exr") {
            damage("a.exr", &std::fs::read(&path).unwrap(), 10);
            count += 1;
        }
    }
    assert!(count > 30, "{count}");
}

#[test]
fn damaged_frames_do_no_harm() {
    use image::ExtendedColorType::Rgba8;
    let folder = tempfile::tempdir().unwrap();
    let pixels: Vec<u8> = (0..4 * 64).map(|i| (i * 37) as u8).collect();
    for ending in ["png", "tif", "webp", "tga", "qoi"] {
        let path = folder.path().join(format!("whole.{ending}"));
        image::save_buffer(&path, &pixels, 8, 8, Rgba8).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        damage(&format!("a.{ending}"), &bytes, 30);
    }
    let head = b"#?RADIANCE\nEXPOSURE=2\nPRIMARIES=.6 .3 .3 .6 .1 .1 .3 .3\n\n-Y 8 +X 8\n";
    damage("a.hdr", &[head.as_slice(), &pixels].concat(), 60);
    damage("a.pfm", &[b"PF\n7 3\n-1\n".as_slice(), &pixels[..252]].concat(), 40);
}
