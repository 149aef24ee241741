//! Radiance pictures: what the header says is undone, in every code and order.

use super::*;

/// Eight by three pixels, no two alike.
fn pixels() -> Vec<[u8; 4]> {
    (0..24).map(|i| [10 * i + 3, 255 - i, 128, 128 + i / 8]).collect()
}

fn write(path: &Path, header: &str, body: &[u8]) {
    std::fs::write(path, [header.as_bytes(), body].concat()).unwrap();
}

fn colours(path: &Path) -> Vec<f64> {
    let picture = open(path, Alpha::default()).unwrap_or_else(|error| panic!("{error}"));
    assert!(picture.warnings.is_empty(), "{:?}", picture.warnings);
    picture.layers.list[0].data.clone()
}

fn plain(folder: &Path) -> Vec<f64> {
    let path = folder.join("plain.hdr");
    write(&path, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 8\n", &pixels().concat());
    colours(&path)
}

/// mantissa / 256 · 2^(exponent - 128).
#[test]
fn numbers_are_mantissa_and_exponent() {
    let folder = tempfile::tempdir().unwrap();
    let data = plain(folder.path());
    assert_eq!(data[..3], [3.0 / 256.0, 255.0 / 256.0, 0.5]);
    assert_eq!(data[3 * 8 + 2], 1.0);
}

#[test]
fn any_program_and_any_end_of_line_will_do() {
    let folder = tempfile::tempdir().unwrap();
    let expected = plain(folder.path());
    let path = folder.path().join("a.hdr");
    for header in [
        "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 8\n",
        "#?Snell 1.0\n# a comment\nVIEW= -vtv\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 8\n",
        "#?\n\n-Y 3 +X 8\n",
        "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 3 +X 8\r\n",
    ] {
        write(&path, header, &pixels().concat());
        assert_eq!(colours(&path), expected, "{header}");
    }
}

#[test]
fn exposures_and_colour_corrections_are_divided_out() {
    let folder = tempfile::tempdir().unwrap();
    let expected = plain(folder.path());
    let path = folder.path().join("a.hdr");
    let lines = "\tEXPOSURE=3\nEXPOSURE=8\nEXPOSURE= 0.5\nCOLORCORR=1 2 4\nCOLORCORR= 1 1 0.5\n";
    write(&path, &format!("#?RADIANCE\n{lines}\n-Y 3 +X 8\n"), &pixels().concat());
    for (place, (found, expected)) in colours(&path).iter().zip(expected).enumerate() {
        assert_eq!(found * 4.0 * [1.0, 2.0, 2.0][place % 3], expected);
    }
    write(&path, "#?RADIANCE\nEXPOSURE=0\n\n-Y 3 +X 8\n", &pixels().concat());
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("`EXPOSURE=0`"), "{error}");
}

/// The eight orders of the pixels, each by where the file's second pixel and
/// second line go.
#[test]
fn eight_orientations() {
    let folder = tempfile::tempdir().unwrap();
    let expected = plain(folder.path());
    let path = folder.path().join("a.hdr");
    let all = pixels();
    for (first, second) in [("-Y", "+X"), ("-Y", "-X"), ("+Y", "+X"), ("+Y", "-X")] {
        for columns_first in [false, true] {
            let place = |x: usize, y: usize| {
                let x = if second == "-X" { 7 - x } else { x };
                let y = if first == "+Y" { 2 - y } else { y };
                all[8 * y + x]
            };
            let (order, body): (String, Vec<[u8; 4]>) = if columns_first {
                let body = (0..24).map(|i| place(i / 3, i % 3)).collect();
                (format!("{second} 8 {first} 3"), body)
            } else {
                let body = (0..24).map(|i| place(i % 8, i / 8)).collect();
                (format!("{first} 3 {second} 8"), body)
            };
            write(&path, &format!("#?RADIANCE\n\n{order}\n"), &body.concat());
            assert_eq!(colours(&path), expected, "{order}");
        }
    }
}

#[test]
fn both_run_length_codes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hdr");
    // The newer: 2, 2, length, then each component in runs and literals.
    let mut newer = vec![2, 2, 0, 8];
    newer.extend([128 + 8, 7]);
    newer.extend([3, 1, 2, 3, 128 + 5, 4]);
    newer.extend([8, 1, 2, 3, 4, 5, 6, 7, 8]);
    newer.extend([128 + 8, 129]);
    write(&path, "#?RADIANCE\n\n-Y 1 +X 8\n", &newer);
    let data = colours(&path);
    assert_eq!(data[..3], [7.0, 1.0, 1.0].map(|v| v / 128.0));
    assert_eq!(data[21..], [7.0, 4.0, 8.0].map(|v| v / 128.0));
    // The older: 1, 1, 1, n repeats; the next one counts 256 times as much.
    let older = [[9, 8, 7, 128], [1, 1, 1, 4], [1, 1, 1, 1], [5, 5, 5, 128]].concat();
    write(&path, "#?RADIANCE\n\n-Y 1 +X 262\n", &older);
    let data = colours(&path);
    assert!(data[..3 * 261].chunks(3).all(|p| p == [9.0 / 256.0, 8.0 / 256.0, 7.0 / 256.0]));
    assert_eq!(data[3 * 261], 5.0 / 256.0);
    // A run that leaves its line is broken.
    write(&path, "#?RADIANCE\n\n-Y 1 +X 4\n", &older);
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("broken or cut off"), "{error}");
}

/// White of any primaries is white; their green is more than Rec. 709 has.
#[test]
fn primaries_and_xyz_become_rec_709() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hdr");
    let primaries = "PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n";
    let body = [[128, 128, 128, 129], [0, 128, 0, 129]].concat();
    write(&path, &format!("#?RADIANCE\n{primaries}\n-Y 1 +X 2\n"), &body);
    let data = colours(&path);
    for (found, expected) in data.iter().zip([1.0, 1.0, 1.0, -0.5876, 1.1329, -0.1006]) {
        assert!((found - expected).abs() < 3e-4, "{data:?}");
    }
    // XYZ of Rec. 709's red: 0.4124, 0.2126, 0.0193, to eight bits.
    let body = [106, 54, 5, 128];
    write(&path, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", &body);
    let data = colours(&path);
    for (found, expected) in data.iter().zip([1.0, 0.0, 0.0]) {
        assert!((found - expected).abs() < 0.02, "{data:?}");
    }
    write(&path, "#?RADIANCE\nFORMAT=spectra\n\n-Y 1 +X 1\n", &body);
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("spectra") && error.contains("32-bit_rle_rgbe"), "{error}");
}
