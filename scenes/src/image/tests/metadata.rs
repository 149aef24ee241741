//! What frames say beside their pixels: orientation, kind of opacity, depth.

use super::*;
use image::{ExtendedColorType, ImageFormat};

fn shown(path: &Path) -> Picture {
    open(path, Alpha::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// A camera held upright writes its image lying and says so: Exif orientation 6.
#[test]
fn cameras_are_turned_upright() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.jpg");
    let mut jpeg = std::io::Cursor::new(Vec::new());
    // The left half is dark, the right half bright.
    let pixels: Vec<u8> = (0..16 * 8).map(|i| if i % 16 < 8 { 20 } else { 230 }).collect();
    image::write_buffer_with_format(
        &mut jpeg,
        &pixels,
        16,
        8,
        ExtendedColorType::L8,
        ImageFormat::Jpeg,
    )
    .unwrap();
    // TIFF 6.0: little endian, one entry: tag 274, SHORT, one value.
    let tiff = |orientation: u8| {
        let mut exif = b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".to_vec();
        exif.extend([orientation, 0, 0, 0, 0, 0, 0, 0]);
        let length = (exif.len() as u16 + 2).to_be_bytes();
        [&[0xff, 0xe1][..], &length, &exif].concat()
    };
    for (orientation, size_px, corner) in
        [(1, [16, 8], 20.0), (6, [8, 16], 20.0), (3, [16, 8], 230.0), (8, [8, 16], 230.0)]
    {
        let (start, rest) = jpeg.get_ref().split_at(2);
        std::fs::write(&path, [start, &tiff(orientation), rest].concat()).unwrap();
        let picture = shown(&path);
        assert_eq!(picture.layers.resolution_px, size_px, "{orientation}");
        let found = picture.layers.list[0].data[0] * 255.0;
        assert!((found - corner).abs() < 4.0, "{orientation}: {found}");
    }
}

/// A TIFF of one RGBA pixel of 8 bits whose fourth sample is of this kind.
fn tiff_of(extra: u16, pixel: [u8; 4]) -> Vec<u8> {
    let mut bytes = b"II*\0\x08\0\0\0".to_vec();
    let entries: [(u16, u16, u32, u32); 10] = [
        (256, 3, 1, 1),                // width
        (257, 3, 1, 1),                // height
        (258, 3, 4, 134),              // bits, after the entries
        (259, 3, 1, 1),                // not packed
        (262, 3, 1, 2),                // RGB
        (273, 4, 1, 142),              // pixels, after the bits
        (277, 3, 1, 4),                // samples
        (278, 3, 1, 1),                // rows in a strip
        (279, 4, 1, 4),                // bytes of the strip
        (338, 3, 1, u32::from(extra)), // kind of the extra sample
    ];
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend(count.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    bytes.extend([8u16; 4].map(u16::to_le_bytes).concat());
    bytes.extend(pixel);
    bytes
}

/// Opacity that colours are multiplied by already (ExtraSamples 1) is not
/// multiplied again.
#[test]
fn tiff_tells_the_kind_of_its_opacity() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.tif");
    for (extra, expected) in [(1, 0.4), (2, 0.4 * 0.6)] {
        std::fs::write(&path, tiff_of(extra, [102, 102, 102, 153])).unwrap();
        let picture = shown(&path);
        assert!((picture.layers.list[0].data[0] - expected).abs() < 1e-12, "{extra}");
        assert!(picture.warnings.is_empty(), "{:?}", picture.warnings);
        assert_eq!(picture.alpha.unwrap(), [0.6]);
    }
    std::fs::write(&path, tiff_of(0, [102, 102, 102, 153])).unwrap();
    assert!(shown(&path).warnings[0].contains("not said to be alpha"));
}

/// Sixteen bits keep all of them; a palette's opacity is found in `tRNS`.
#[test]
fn every_depth_and_palette_of_png() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let deep: Vec<u8> = [257u16, 40_000, 65_535].map(u16::to_ne_bytes).concat();
    image::save_buffer(&path, &deep, 1, 1, ExtendedColorType::Rgb16).unwrap();
    assert_eq!(shown(&path).layers.list[0].data, [257.0, 40_000.0, 65_535.0].map(|v| v / 65_535.0));
    let file = std::fs::File::create(&path).unwrap();
    let mut encoder = ::png::Encoder::new(file, 4, 1);
    encoder.set_color(::png::ColorType::Indexed);
    encoder.set_depth(::png::BitDepth::Two);
    encoder.set_palette(vec![255, 0, 0, 0, 255, 0, 0, 0, 255, 51, 51, 51]);
    encoder.set_trns(vec![255, 0]);
    encoder.write_header().unwrap().write_image_data(&[0b0001_1011]).unwrap();
    let picture = shown(&path);
    assert_eq!(picture.alpha.as_deref(), Some(&[1.0, 0.0, 1.0, 1.0][..]));
    let expected = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.2, 0.2, 0.2];
    assert_eq!(picture.layers.list[0].data, expected);
    let file = std::fs::File::create(&path).unwrap();
    let mut encoder = ::png::Encoder::new(file, 8, 1);
    encoder.set_depth(::png::BitDepth::One);
    encoder.set_color(::png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&[0b1010_0000]).unwrap();
    assert_eq!(shown(&path).layers.list[0].data[..6], [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
}

/// Grey floats, which the `image` crate refuses: one pixel of 2.5.
#[test]
fn grey_floats_of_tiff_are_radiance() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.tif");
    let mut bytes = b"II*\0\x08\0\0\0".to_vec();
    let entries = [
        (256u16, 1u32),
        (257, 1),
        (258, 32),
        (259, 1),
        (262, 1),
        (273, 122),
        (277, 1),
        (278, 1),
        (279, 4),
    ];
    let value = |(tag, value): (u16, u32)| {
        [&tag.to_le_bytes()[..], &[4, 0, 1, 0, 0, 0], &value.to_le_bytes()].concat()
    };
    bytes.extend([9, 0]);
    bytes.extend(entries.into_iter().flat_map(value));
    bytes.extend([0; 4]);
    // Without a sample format the 32 bits are a whole number, which is refused.
    std::fs::write(&path, [&bytes[..], &2.5f32.to_le_bytes()].concat()).unwrap();
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("8 or 16 bits") && !error.contains("broken"), "{error}");
    bytes[8] = 10;
    let end = bytes.len() - 4;
    bytes.splice(end..end, value((339, 3)));
    bytes[10 + 5 * 12 + 8] = 134;
    std::fs::write(&path, [&bytes[..], &2.5f32.to_le_bytes()].concat()).unwrap();
    let picture = shown(&path);
    assert_eq!(picture.layers.list[0].data, [2.5; 3]);
    assert_eq!(picture.encoding, Encoding::Linear);
}
