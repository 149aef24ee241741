//! OpenEXR files that other software wrote (`tests/exr`, README.md there).

use super::*;
use crate::Layer;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/exr").join(name)
}

pub(super) fn shown(path: &Path) -> Picture {
    open(path, Alpha::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn radiance(picture: &Picture) -> &Layer {
    picture.layers.get(&LayerName::Radiance).unwrap()
}

/// The largest difference between an image and a function of column and row.
pub(super) fn farthest(picture: &Picture, expected: impl Fn(f64, f64) -> [f64; 3]) -> f64 {
    let [width, _] = picture.layers.resolution_px;
    let pixels = radiance(picture).data.chunks_exact(3).zip(0..);
    let worst = pixels.flat_map(|(pixel, place): (&[f64], u32)| {
        let expected = expected(f64::from(place % width), f64::from(place / width));
        [0, 1, 2].map(|i| (pixel[i] - expected[i]).abs())
    });
    worst.fold(0.0, f64::max)
}

fn gradient(x: f64, y: f64) -> [f64; 3] {
    [x / 32.0, y / 16.0, (x + y) / 64.0]
}

/// What lossy codecs lose is what OpenEXR's own reader finds in the same files.
#[test]
fn every_codec_gives_the_same_pixels() {
    for (codec, half, float) in [
        ("none", 0.0, None),
        ("rle", 0.0, Some(0.0)),
        ("zips", 0.0, None),
        ("zip", 0.0, Some(0.0)),
        ("piz", 0.0, Some(0.0)),
        ("pxr24", 0.0, Some(0.0)),
        ("b44", 1.0 / 64.0, None),
        ("b44a", 1.0 / 64.0, None),
        ("dwaa", 4.6e-3, Some(4.6e-3)),
        ("dwab", 4.6e-3, None),
    ] {
        for (kind, most) in [("half", Some(half)), ("float", float)] {
            let Some(most) = most else { continue };
            let picture = shown(&file(&format!("rgb-{codec}-{kind}.exr")));
            let error = farthest(&picture, gradient);
            assert!(error <= most, "{codec} {kind}: {error}");
            assert_eq!(picture.layers.resolution_px, [24, 16]);
        }
    }
}

#[test]
fn tiles_and_maps_of_levels_are_read_in_full_resolution() {
    for name in ["tiled.exr", "mipmap.exr", "ripmap.exr"] {
        assert_eq!(farthest(&shown(&file(name)), gradient), 0.0, "{name}");
    }
}

#[test]
fn whole_numbers_keep_all_their_digits() {
    let expected = |x: f64, y: f64| [1000.0 * x, 70_000.0 * y, 4_294_967_295.0];
    assert_eq!(farthest(&shown(&file("uint.exr")), expected), 0.0);
}

/// Luminance and chroma, at half and at a quarter of the pixels, from (-4, 2).
#[test]
fn luminance_and_chroma_are_colour_in_every_codec() {
    let codecs = ["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"];
    let halves = codecs.map(|codec| format!("ych-{codec}"));
    let others = ["ycf-zip", "ycf-piz", "ycf-pxr24", "ycf-b44", "yc41-zip", "yc41-piz", "yc41-b44"];
    for name in halves.iter().map(String::as_str).chain(others) {
        let picture = shown(&file(&format!("{name}.exr")));
        assert_eq!(picture.layers.resolution_px, [24, 36]);
        let error = farthest(&picture, |x, y| {
            let luminance = (x + 2.0 * y + 8.0) / 128.0;
            let (red, blue) = (1.5 * luminance, 0.75 * luminance);
            [red, (luminance - 0.2126 * red - 0.0722 * blue) / 0.7152, blue]
        });
        let is_lossy = ["b44", "b44a", "dwaa", "dwab"].iter().any(|codec| name.ends_with(codec));
        let most = if is_lossy && !name.starts_with("ycf") { 1.5e-2 } else { 2e-4 };
        assert!(error < most, "{name}: {error}");
    }
}

/// The library's own reader of luminance and chroma, which also lowers the
/// saturation of single pixels, agrees on a smooth image.
#[test]
fn colours_are_those_of_the_library() {
    let picture = shown(&file("rgba-yc.exr"));
    let text = std::fs::read_to_string(file("rgba-yc.txt")).unwrap();
    let theirs: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    let ours = &radiance(&picture).data;
    assert_eq!(ours.len(), theirs.len());
    let worst = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 4e-3, "{worst}");
}

/// Parts of windows of their own stand where they belong: overscan is cut, what
/// the file does not cover is black.
#[test]
fn parts_stand_where_their_windows_say() {
    let path = file("parts.exr");
    let picture = shown(&path);
    assert_eq!(picture.layers.resolution_px, [16, 10]);
    assert_eq!(farthest(&picture, |x, y| gradient(x + 2.0, y + 3.0)), 0.0);
    let depth = shown(Path::new(&format!("{}:depth", path.display())));
    let expected = |x: f64, y: f64| [if x < 4.0 || y < 2.0 { 0.0 } else { (x - 4.0) / 32.0 }; 3];
    assert_eq!(farthest(&depth, expected), 0.0);
}

#[test]
fn deep_data_is_refused_by_name() {
    let error = open(&file("deep.exr"), Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("deep data") && error.contains("flatten"), "{error}");
    assert!(!error.contains("broken"), "{error}");
}

/// Channels of constants, written by the `exr` crate: name and value.
pub(super) fn constants(path: &Path, channels: &[(&str, f32)], size: (usize, usize)) {
    use ::exr::prelude::*;
    let list = channels.iter().map(|(name, value)| {
        let values = vec![f16::from_f32(*value); size.0 * size.1];
        AnyChannel::new(Text::new_or_panic(*name), FlatSamples::F16(values))
    });
    let channels = AnyChannels::sort(list.collect());
    let named = LayerAttributes::default();
    let layer = ::exr::prelude::Layer::new(size, named, Encoding::SMALL_FAST_LOSSLESS, channels);
    Image::from_layer(layer).write().to_file(path).unwrap();
}

pub(super) fn first_pixel(path: &Path) -> [f64; 3] {
    let picture = shown(path);
    radiance(&picture).data[..3].try_into().unwrap()
}

#[test]
fn chromaticities_become_rec_709() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.exr");
    let write = |xy: Option<[f32; 8]>| {
        use ::exr::prelude::*;
        let one = |name: &'static str, value: f32| {
            AnyChannel::new(name, FlatSamples::F32(vec![value; 4]))
        };
        let channels =
            AnyChannels::sort([one("R", 1.0), one("G", 0.5), one("B", 0.25)].into_iter().collect());
        let layer = ::exr::prelude::Layer::new(
            (2, 2),
            LayerAttributes::default(),
            Encoding::UNCOMPRESSED,
            channels,
        );
        let mut image = Image::from_layer(layer);
        image.attributes.chromaticities = xy.map(|xy| ::exr::meta::attribute::Chromaticities {
            red: Vec2(xy[0], xy[1]),
            green: Vec2(xy[2], xy[3]),
            blue: Vec2(xy[4], xy[5]),
            white: Vec2(xy[6], xy[7]),
        });
        image.write().to_file(&path).unwrap();
    };
    let rec_709 = [0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290];
    for same in [None, Some(rec_709)] {
        write(same);
        assert_eq!(first_pixel(&path), [1.0, 0.5, 0.25]);
    }
    // Rec. 2020: the matrix of ITU-R BT.2087-0, annex 2, inverted.
    write(Some([0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290]));
    let expected = [
        1.6605 - 0.5876 / 2.0 - 0.0728 / 4.0,
        -0.1246 + 1.1329 / 2.0 - 0.0083 / 4.0,
        -0.0182 - 0.1006 / 2.0 + 1.1187 / 4.0,
    ];
    for (found, expected) in first_pixel(&path).iter().zip(expected) {
        assert!((found - expected).abs() < 3e-4, "{found} {expected}");
    }
}

/// Opacity is in the colours of OpenEXR already: only white shows through.
#[test]
fn colours_of_openexr_are_multiplied_by_their_opacity() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    constants(&path, &[("R", 0.25), ("G", 0.5), ("B", 0.0), ("A", 0.5)], (2, 2));
    for (alpha, expected) in [
        (Alpha::OverBlack, [0.25, 0.5, 0.0]),
        (Alpha::OverWhite, [0.75, 1.0, 0.5]),
        (Alpha::Ignore, [0.25, 0.5, 0.0]),
    ] {
        let picture = open(&path, alpha).unwrap();
        assert_eq!(radiance(&picture).data[..3], expected, "{alpha:?}");
        assert_eq!(picture.alpha.unwrap()[0], 0.5);
    }
}
