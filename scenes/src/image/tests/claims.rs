//! What headers claim is weighed before memory is reserved for it.

use super::openexr::{constants, farthest, shown};
use super::*;

/// An OpenEXR file of float R, G, B in blocks of 16 rows that are all this one.
fn of_one_block(size_px: [u32; 2], packed: &[u8]) -> Vec<u8> {
    let window = [0, 0, size_px[0] - 1, size_px[1] - 1].map(u32::to_le_bytes).concat();
    let channel =
        |name: u8| [&[name, 0, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0][..]].concat();
    let channels = [channel(b'B'), channel(b'G'), channel(b'R'), vec![0]].concat();
    let mut bytes = [0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0].to_vec();
    for (name, kind, value) in [
        ("channels", "chlist", &channels),
        ("compression", "compression", &vec![3]),
        ("dataWindow", "box2i", &window),
        ("displayWindow", "box2i", &window),
    ] {
        bytes.extend([name, "\0", kind, "\0"].concat().bytes());
        bytes.extend((value.len() as u32).to_le_bytes());
        bytes.extend(value);
    }
    bytes.push(0);
    let count = size_px[1].div_ceil(16);
    let first = bytes.len() + 8 * count as usize;
    let offsets = (0..count as usize).map(|i| (first + i * (8 + packed.len())) as u64);
    bytes.extend(offsets.flat_map(u64::to_le_bytes));
    for block in 0..count {
        bytes.extend((16 * block).to_le_bytes());
        bytes.extend((packed.len() as u32).to_le_bytes());
        bytes.extend(packed);
    }
    bytes
}

/// An image of one value packs 1000 to 1, which is what deflate can. A file of a
/// tenth of that is refused before memory is reserved.
#[test]
fn a_valid_image_of_one_value_is_read_and_a_claim_is_not() {
    use std::io::Write;
    let size_px = [8192, 4096];
    // Black: differences of 0 are 128, and the first byte is itself.
    let mut row = vec![128; 16 * 12 * 8192];
    row[0] = 0;
    let mut deflated = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    deflated.write_all(&row).unwrap();
    let packed = deflated.finish().unwrap();
    let path = Path::new("constant.exr");
    let located = |bytes: &[u8]| {
        let (size_px, file_bytes) = (size_px.map(u64::from), bytes.len() as u64);
        crate::image::exr::located(&claim::Claim { path, size_px, file_bytes }, bytes)
    };
    let valid = of_one_block(size_px, &packed);
    assert!((380_000..440_000).contains(&valid.len()), "{}", valid.len());
    assert_eq!(located(&valid).unwrap(), 256);
    let error = located(&of_one_block(size_px, &packed[..140])).unwrap_err().to_string();
    assert!(error.contains("8192 x 4096 pixels in 4") && error.contains("too short"), "{error}");
    // The same pixels, fewer of them, are really unpacked.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("small.exr");
    std::fs::write(&path, of_one_block([8192, 32], &packed)).unwrap();
    assert_eq!(farthest(&shown(&path), |_, _| [0.0; 3]), 0.0);
}

/// 10^9 pixels in 40 KB, and a small picture in the corner of a huge black one.
#[test]
fn claims_are_refused_before_memory_is_reserved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("claim.exr");
    let mut bytes = of_one_block([32_000, 32_000], &[0; 10]);
    bytes.resize(40_000, 0);
    std::fs::write(&path, &bytes).unwrap();
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("claims 32000 x 32000 pixels in 40000 bytes"), "{error}");
    constants(&path, &[("R", 0.5), ("G", 0.5), ("B", 0.5)], (3, 2));
    let bytes = std::fs::read(&path).unwrap();
    let name = b"displayWindow\0box2i\0";
    let at = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 4 + 8;
    let mut speck = bytes.clone();
    speck[at..at + 8].copy_from_slice(&[20_000i32.to_le_bytes(), 20_000i32.to_le_bytes()].concat());
    std::fs::write(&path, &speck).unwrap();
    let error = open(&path, Alpha::default()).unwrap_err().to_string();
    assert!(error.contains("crop the display window"), "{error}");
}
