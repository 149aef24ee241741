//! Images survive the disk, and what is broken is refused.
#![allow(clippy::unwrap_used, reason = "a failing test may panic")]

mod claims;
mod damage;
mod frames;
mod metadata;
mod names;
mod openexr;
mod radiance;

use super::*;
use crate::{LayerName, Layers};
use std::path::{Path, PathBuf};

/// A small image with one layer of every kind; all values are exact in f32.
fn layers() -> Layers {
    let mut layers = Layers::new([3, 2]);
    let mut next = 0.0;
    for (name, channels) in [
        (LayerName::Radiance, 3),
        (LayerName::Coverage, 1),
        (LayerName::Exit, 3),
        (LayerName::ExitPosition, 3),
        (LayerName::First, 3),
        (LayerName::Hit2, 3),
        (LayerName::Events, 1),
        (LayerName::TotalReflections, 1),
        (LayerName::Flags, 1),
        (LayerName::Truncated, 1),
        (LayerName::Variance, 3),
        (LayerName::Samples, 1),
        (LayerName::Path("glass".to_owned()), 1),
        (LayerName::Bounce(2), 3),
        (LayerName::Buffer("front_depth".to_owned()), 1),
    ] {
        let mut data = Vec::new();
        for _ in 0..6 * channels {
            next += 0.25;
            data.push(next);
        }
        layers.push(name, channels, data);
    }
    layers
}

fn sorted(mut layers: Layers) -> Layers {
    layers.list.sort_by(|a, b| a.name.cmp(&b.name));
    layers
}

#[test]
fn every_layer_comes_back_from_an_exr() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    write_exr(&path, &layers()).unwrap();
    assert_eq!(sorted(read(&path).unwrap()), sorted(layers()));
}

#[test]
fn channels_follow_the_openexr_convention_and_carry_provenance() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    let told = [("scene", "ball"), ("method", "Lupe \u{436}\0")];
    let attributes = told.map(|(name, value)| (name.to_owned(), value.to_owned())).into();
    write_exr_with(&path, &layers(), &attributes).unwrap();
    let meta = ::exr::meta::MetaData::read_from_file(&path, true).unwrap();
    let header = &meta.headers[0];
    let names: Vec<_> = header.channels.list.iter().map(|c| c.name.to_string()).collect();
    for name in [
        "R",
        "G",
        "B",
        "coverage.Y",
        "exit.X",
        "exit.Y",
        "exit.Z",
        "first.X",
        "hit2.Z",
        "events.Y",
        "flags.Y",
        "truncated.Y",
        "variance.R",
        "variance.B",
        "samples.Y",
        "path.glass.Y",
    ] {
        assert!(names.iter().any(|n| n == name), "{name} is missing in {names:?}");
    }
    let scene = header.own_attributes.other.iter().find(|(name, _)| *name == "snell:scene");
    let expected = ::exr::meta::attribute::AttributeValue::Text("ball".into());
    // UTF-8, as other readers of the format have it; a null would end the text.
    let method = header.own_attributes.other.iter().find(|(name, _)| *name == "snell:method");
    let (_, ::exr::meta::attribute::AttributeValue::Text(method)) = method.unwrap() else {
        panic!("{method:?}")
    };
    assert_eq!(method.as_slice(), "Lupe \u{436} ".as_bytes());
    assert_eq!(scene.unwrap().1, &expected);
}

/// f64 beyond f32 stays finite; bad values stay visible.
#[test]
fn narrowing_makes_no_infinity() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    let mut huge = Layers::new([1, 1]);
    huge.push(LayerName::Radiance, 3, vec![1e300, -1e300, f64::NAN]);
    write_exr(&path, &huge).unwrap();
    let back = read(&path).unwrap();
    let radiance = &back.get(&LayerName::Radiance).unwrap().data;
    assert_eq!(radiance[..2], [f64::from(f32::MAX), -f64::from(f32::MAX)]);
    assert!(radiance[2].is_nan());
}

#[test]
fn a_cut_off_file_is_refused_at_every_length() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    write_exr(&path, &layers()).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for length in (0..whole.len()).step_by(whole.len() / 40) {
        std::fs::write(&path, &whole[..length]).unwrap();
        let error = read(&path).unwrap_err().to_string();
        assert!(error.contains("broken or cut off"), "{length}: {error}");
    }
}

/// Flipped bytes give an error or an image, never a panic or a hang.
#[test]
fn garbage_does_no_harm() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    write_exr(&path, &layers()).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for position in (0..whole.len()).step_by(7) {
        for value in [0x00, 0xff, 0x7f] {
            let mut bytes = whole.clone();
            bytes[position] = value;
            std::fs::write(&path, bytes).unwrap();
            let _ = read(&path);
        }
    }
}

/// Replaces the data window in an EXR header: xMin, yMin, xMax, yMax.
fn with_window(bytes: &[u8], window: [i32; 4]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for name in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
        let at = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 4;
        for (i, value) in window.iter().enumerate() {
            bytes[at + 4 * i..at + 4 * i + 4].copy_from_slice(&value.to_le_bytes());
        }
    }
    bytes
}

#[test]
fn empty_images_and_absurd_claims_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("image.exr");
    write_exr(&path, &layers()).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for window in [[0, 0, -1, -1], [0, 0, 1_000_000_000, 1_000_000_000], [0, 0, 16_000, 16_000]] {
        std::fs::write(&path, with_window(&whole, window)).unwrap();
        let start = std::time::Instant::now();
        let error = read(&path).unwrap_err().to_string();
        assert!(start.elapsed().as_secs_f64() < 1.0, "{window:?} took long");
        assert!(error.contains("image.exr"), "{error}");
    }
    let claim = std::fs::read(&path).unwrap();
    assert_eq!(claim.len(), whole.len());
    let error = read(&path).unwrap_err().to_string();
    assert!(error.contains("16001 x 16001 pixels in"), "{error}");

    let path = folder.path().join("zero.hdr");
    std::fs::write(&path, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n").unwrap();
    let error = read(&path).unwrap_err().to_string();
    assert!(error.contains("0 x 0 pixels"), "{error}");
    std::fs::write(&path, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 20000\n").unwrap();
    let error = read(&path).unwrap_err().to_string();
    assert!(error.contains("claims 20000 x 20000 pixels"), "{error}");
    let nothing = write_exr(&folder.path().join("none.exr"), &Layers::new([0, 4])).unwrap_err();
    assert!(nothing.to_string().contains("0 x 4 pixels"), "{nothing}");
}

#[test]
fn radiance_hdr_is_read_as_light() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.hdr");
    // RGBE: mantissas / 256 * 2^(exponent - 128).
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n".to_vec();
    bytes.extend([128, 64, 32, 129, 128, 128, 128, 138]);
    std::fs::write(&path, bytes).unwrap();
    let (map, warnings) = read_lat_long(&path).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(map.size_px, [2, 1]);
    assert_eq!(map.texels, [[1.0, 0.5, 0.25], [512.0, 512.0, 512.0]]);
}

/// Middle grey of sRGB, code 188 of 255, is 0.5029 in linear light.
#[test]
fn png_is_written_and_read_as_srgb() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grey.png");
    let mut grey = Layers::new([1, 1]);
    grey.push(LayerName::Radiance, 3, vec![0.5029, 0.0, 7.0]);
    let clip = Preview { exposure_stops: 0.0, tone_map: ToneMap::Clip };
    write_png(&path, &grey, &clip).unwrap();
    let back = read(&path).unwrap().list.remove(0).data;
    assert!((back[0] - 0.5029).abs() < 1e-4 && back[1] == 0.0 && back[2] == 1.0, "{back:?}");
}

#[test]
fn previews_rise_with_radiance_and_bear_anything() {
    for tone_map in [ToneMap::Clip, ToneMap::Reinhard] {
        let preview = Preview { exposure_stops: 1.0, tone_map };
        let codes: Vec<u8> = (0..100).map(|i| preview.code(f64::from(i) * 0.05)).collect();
        assert!(codes.is_sorted() && codes[0] == 0 && codes[99] == 255, "{codes:?}");
        assert_eq!([f64::NAN, -1.0, f64::INFINITY].map(|v| preview.code(v)), [0, 0, 255]);
    }
    // The white point: radiance 4 is the first to be white.
    let reinhard = Preview::default();
    assert!(reinhard.code(3.9) < 255 && reinhard.code(4.0) == 255);
}

#[test]
fn nothing_is_left_where_nothing_could_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("taken.exr");
    std::fs::create_dir(&path).unwrap();
    let error = write_exr(&path, &layers()).unwrap_err().to_string();
    assert!(error.contains("cannot write"), "{error}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let mut no_colour = Layers::new([1, 1]);
    no_colour.push(LayerName::Events, 1, vec![1.0]);
    let path = folder.path().join("events.exr");
    write_exr(&path, &no_colour).unwrap();
    let error = read_lat_long(&path).unwrap_err().to_string();
    assert!(error.contains("no R, G, B or Y channel (it has events (Y))"), "{error}");
}
