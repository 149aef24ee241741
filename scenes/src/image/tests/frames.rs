//! PNG and the other kinds that people keep frames in.

use super::*;
use image::{ExtendedColorType, ImageFormat};

fn shown(path: &Path, alpha: Alpha) -> Picture {
    open(path, alpha).unwrap_or_else(|error| panic!("{error}"))
}

fn first(picture: &Picture) -> [f64; 3] {
    picture.layers.list[0].data[..3].try_into().unwrap()
}

/// A PNG of one colour of 8 bits, with these chunks before its pixels.
fn png_with(path: &Path, pixel: &[u8], chunks: &[(&[u8; 4], &[u8])]) {
    let kind = if pixel.len() == 4 { ExtendedColorType::Rgba8 } else { ExtendedColorType::Rgb8 };
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut bytes, &pixel.repeat(4), 2, 2, kind, ImageFormat::Png)
        .unwrap();
    // The signature and IHDR take 33 bytes.
    let (head, rest) = bytes.get_ref().split_at(33);
    let mut whole = head.to_vec();
    for (name, data) in chunks {
        let mut crc = flate2::Crc::new();
        crc.update(&name[..]);
        crc.update(data);
        whole.extend((data.len() as u32).to_be_bytes());
        whole.extend_from_slice(&name[..]);
        whole.extend_from_slice(data);
        whole.extend(crc.sum().to_be_bytes());
    }
    whole.extend_from_slice(rest);
    std::fs::write(path, whole).unwrap();
}

/// The data of an `iCCP` chunk.
fn iccp(profile: &moxcms::ColorProfile) -> Vec<u8> {
    use std::io::Write;
    let mut deflated = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
    deflated.write_all(&profile.encode().unwrap()).unwrap();
    [b"a\0\0".as_slice(), &deflated.finish().unwrap()].concat()
}

#[test]
fn opacity_is_laid_as_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    png_with(&path, &[255, 51, 0, 51], &[]);
    for (alpha, expected) in [
        (Alpha::OverBlack, [0.2, 0.04, 0.0]),
        (Alpha::OverWhite, [1.0, 0.84, 0.8]),
        (Alpha::Ignore, [1.0, 0.2, 0.0]),
    ] {
        let picture = shown(&path, alpha);
        for (found, expected) in first(&picture).iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{alpha:?}: {found}");
        }
        assert_eq!(picture.alpha.unwrap(), [0.2; 4]);
        assert_eq!(picture.encoding, Encoding::Display);
    }
}

#[test]
fn a_gamma_that_is_not_srgb_is_converted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let code = |chunks: &[(&[u8; 4], &[u8])]| {
        png_with(&path, &[128, 64, 255], chunks);
        let picture = shown(&path, Alpha::default());
        assert!(picture.warnings.is_empty(), "{:?}", picture.warnings);
        first(&picture)
    };
    let plain = [128.0, 64.0, 255.0].map(|v| v / 255.0);
    let (srgb, linear) = (45_455u32.to_be_bytes(), 100_000u32.to_be_bytes());
    assert_eq!(code(&[]), plain);
    assert_eq!(code(&[(b"gAMA", &srgb)]), plain);
    // Linear light of 128 / 255 is code 0.7367 of sRGB; the chunk sRGB goes first.
    let converted = code(&[(b"gAMA", &linear)]);
    assert!((converted[0] - 0.736_647).abs() < 1e-6, "{converted:?}");
    assert!((converted[2] - 1.0).abs() < 1e-9, "{converted:?}");
    assert_eq!(code(&[(b"gAMA", &linear), (b"sRGB", &[0])]), plain);
}

#[test]
fn code_points_and_profiles_go_before_the_gamma() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let pixel = [200, 100, 100];
    let linear = 100_000u32.to_be_bytes();
    let gamma: (&[u8; 4], &[u8]) = (b"gAMA", &linear);
    png_with(&path, &pixel, &[gamma, (b"cICP", &[12, 13, 0, 1])]);
    let by_code_points = first(&shown(&path, Alpha::default()));
    let profile = iccp(&moxcms::ColorProfile::new_display_p3());
    png_with(&path, &pixel, &[gamma, (b"iCCP", &profile)]);
    let by_profile = first(&shown(&path, Alpha::default()));
    // Display P3 to sRGB by the two matrices, SMPTE EG 432-1 and IEC 61966-2-1.
    for (found, expected) in by_code_points.iter().zip([214.90, 92.61, 96.64]) {
        assert!((found * 255.0 - expected).abs() < 0.05, "{by_code_points:?}");
    }
    for (a, b) in by_code_points.iter().zip(by_profile) {
        assert!((a - b).abs() < 1e-3, "{by_code_points:?} {by_profile:?}");
    }
    let profile = iccp(&moxcms::ColorProfile::new_srgb());
    png_with(&path, &pixel, &[gamma, (b"iCCP", &profile)]);
    assert_eq!(first(&shown(&path, Alpha::default())), pixel.map(|v| f64::from(v) / 255.0));
}

#[test]
fn what_srgb_cannot_show_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    // Red of P3 is not in sRGB, and no curve has the number 99.
    for (points, word) in
        [([12, 13, 0, 1], "4 pixels lie outside sRGB"), ([12, 99, 0, 1], "the curve 99")]
    {
        png_with(&path, &[255, 0, 0], &[(b"cICP", &points)]);
        let picture = shown(&path, Alpha::default());
        assert!(picture.warnings[0].contains(word), "{:?}", picture.warnings);
    }
    // Codes 16 to 235 where the range is said to be narrow.
    png_with(&path, &[16, 235, 126], &[(b"cICP", &[1, 13, 0, 0])]);
    let codes = first(&shown(&path, Alpha::default()));
    assert_eq!([codes[0], codes[1]], [0.0, 1.0]);
    assert!((codes[2] - 110.0 / 219.0).abs() < 1e-12, "{codes:?}");
}

/// Rows from the bottom, both byte orders, grey and colour.
#[test]
fn portable_float_maps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pfm");
    let values: Vec<f32> = (0..6).map(|i| i as f32 * 0.5).collect();
    let little: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    let big: Vec<u8> = values.iter().flat_map(|v| v.to_be_bytes()).collect();
    for (header, body) in [("PF\n1 2\n-1.0\n", &little), ("PF 1 2 1\n", &big)] {
        std::fs::write(&path, [header.as_bytes(), body].concat()).unwrap();
        let picture = shown(&path, Alpha::default());
        assert_eq!(picture.layers.list[0].data, [1.5, 2.0, 2.5, 0.0, 0.5, 1.0], "{header}");
        assert_eq!(picture.encoding, Encoding::Linear);
    }
    std::fs::write(&path, [b"Pf\n3 2\n-2\n".as_slice(), &little].concat()).unwrap();
    let picture = shown(&path, Alpha::default());
    assert_eq!(picture.layers.list[0].data[..6], [1.5, 1.5, 1.5, 2.0, 2.0, 2.0]);
    assert!(picture.warnings[0].contains("scale"), "{:?}", picture.warnings);
    std::fs::write(&path, [b"PF\n2 2\n-1\n".as_slice(), &little].concat()).unwrap();
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("24 of 48 bytes"), "{error}");
}

/// The same pixels in every kind that keeps them.
#[test]
fn other_kinds_of_frames() {
    let folder = tempfile::tempdir().unwrap();
    let rgba: Vec<u8> = (0..4 * 6).map(|i| if i % 4 == 3 { 255 } else { i * 10 }).collect();
    let rgb: Vec<u8> = rgba.chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    let expected: Vec<f64> = rgb.iter().map(|v| f64::from(*v) / 255.0).collect();
    for (name, format, is_opaque) in [
        ("a.png", ImageFormat::Png, false),
        ("a.tif", ImageFormat::Tiff, false),
        ("a.webp", ImageFormat::WebP, false),
        ("a.tga", ImageFormat::Tga, false),
        ("a.bmp", ImageFormat::Bmp, true),
        ("a.ppm", ImageFormat::Pnm, true),
        ("a.qoi", ImageFormat::Qoi, false),
    ] {
        let path = folder.path().join(name);
        let (bytes, kind) = if is_opaque {
            (&rgb, ExtendedColorType::Rgb8)
        } else {
            (&rgba, ExtendedColorType::Rgba8)
        };
        image::save_buffer_with_format(&path, bytes, 3, 2, kind, format).unwrap();
        let picture = shown(&path, Alpha::default());
        assert_eq!(picture.layers.list[0].data, expected, "{name}");
        assert_eq!(picture.alpha.is_some(), !is_opaque, "{name}");
        // The content tells the kind, whatever the name.
        if format != ImageFormat::Tga {
            let other = folder.path().join("other.dat");
            std::fs::copy(&path, &other).unwrap();
            assert_eq!(shown(&other, Alpha::default()), picture, "{name}");
        }
    }
    let path = folder.path().join("a.jpg");
    image::save_buffer(&path, &[180; 3 * 64], 8, 8, ExtendedColorType::Rgb8).unwrap();
    assert!((first(&shown(&path, Alpha::default()))[0] - 180.0 / 255.0).abs() < 0.01);
    let path = folder.path().join("float.tiff");
    let floats: Vec<u8> = [0.5f32, 2.0, 8.0].iter().flat_map(|v| v.to_ne_bytes()).collect();
    image::save_buffer(&path, &floats, 1, 1, ExtendedColorType::Rgb32F).unwrap();
    let picture = shown(&path, Alpha::default());
    assert_eq!((first(&picture), picture.encoding), ([0.5, 2.0, 8.0], Encoding::Linear));
}

#[test]
fn what_is_no_image_is_told_what_would_be() {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in [("a.exr", &b"solid cube"[..]), ("a.gif", b"GIF89a"), ("a", b"text")] {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        let error = open(&path, Alpha::default()).unwrap_err().to_string();
        assert!(error.contains("OpenEXR (.exr), Radiance"), "{error}");
        assert!(!error.contains("broken"), "{error}");
    }
    let path = folder.path().join("b.png");
    std::fs::write(&path, b"\x89PN").unwrap();
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("broken or cut off"), "{error}");
}
