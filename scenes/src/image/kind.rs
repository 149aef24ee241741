//! The kind of an image file: what its first bytes say, then its name.

use super::Error;
use super::error::{KINDS, broken, unsupported};
use image::ImageFormat;
use std::path::Path;

/// Kinds of image files that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Exr,
    Radiance,
    Pfm,
    Png,
    Other(ImageFormat),
}

/// A kind, its possible first bytes, and endings of names.
type Marks = (Kind, &'static [&'static [u8]], &'static [&'static str]);
const KNOWN: [Marks; 10] = [
    (Kind::Exr, &[&[0x76, 0x2f, 0x31, 0x01]], &["exr"]),
    (Kind::Radiance, &[b"#?"], &["hdr", "pic", "rgbe", "xyze"]),
    (Kind::Pfm, &[b"PF\n", b"Pf\n", b"PF\r", b"Pf\r", b"PF ", b"Pf "], &["pfm"]),
    (Kind::Png, &[b"\x89PNG\r\n\x1a\n"], &["png"]),
    (Kind::Other(ImageFormat::Jpeg), &[&[0xff, 0xd8, 0xff]], &["jpg", "jpeg"]),
    (Kind::Other(ImageFormat::Tiff), &[b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"], &["tif", "tiff"]),
    (Kind::Other(ImageFormat::WebP), &[b"RIFF"], &["webp"]),
    (Kind::Other(ImageFormat::Bmp), &[b"BM"], &["bmp"]),
    (Kind::Other(ImageFormat::Qoi), &[b"qoif"], &["qoi"]),
    (
        Kind::Other(ImageFormat::Pnm),
        &[b"P1", b"P2", b"P3", b"P4", b"P5", b"P6", b"P7"],
        &["pbm", "pgm", "ppm", "pnm", "pam"],
    ),
];
/// Endings of TGA, whose first bytes say nothing.
const TGA: [&str; 4] = ["tga", "icb", "vda", "vst"];

/// The kind of a file of these bytes.
///
/// # Errors
/// If neither content nor name tell; a file that is cut off within its first
/// bytes is broken.
pub(super) fn kind(path: &Path, bytes: &[u8]) -> Result<Kind, Error> {
    let by_content = KNOWN.iter().find(|(_, marks, _)| marks.iter().any(|m| bytes.starts_with(m)));
    if let Some((kind, ..)) = by_content {
        return Ok(*kind);
    }
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if TGA.contains(&ending.as_str()) {
        return Ok(Kind::Other(ImageFormat::Tga));
    }
    match KNOWN.iter().find(|(_, _, endings)| endings.contains(&ending.as_str())) {
        Some((_, marks, _)) if marks.iter().any(|mark| mark.starts_with(bytes)) => {
            Err(broken(path, format!("it ends after {} bytes", bytes.len())))
        }
        Some(_) => Err(unsupported(
            path,
            format!("its name ends in .{ending}, but its content is no image of a known kind"),
            &format!("use {KINDS}"),
        )),
        None => Err(Error::UnknownKind(path.to_owned())),
    }
}
