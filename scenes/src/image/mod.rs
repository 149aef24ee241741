//! Image files: layers to and from OpenEXR, Radiance HDR and PNG.
//!
//! Nothing is half written: files appear under their name when they are whole.
//! Nothing is allocated on the word of a header that the file cannot keep.

mod claim;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub use read::{read, read_lat_long};
pub use write::{Preview, ToneMap, write_exr, write_exr_with, write_png};

use std::path::{Path, PathBuf};

/// Why an image could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file cannot be opened.
    #[error("cannot read {}: {source}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The name does not tell the kind of image.
    #[error("{}: not a known kind of image\nuse a file that ends in .exr, .hdr or .png", .0.display())]
    UnknownKind(PathBuf),
    /// The content is broken or cut off.
    #[error("{}: {reason}\nfetch or export the file again: it is broken or cut off", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What the decoder said.
        reason: String,
    },
    /// An image without pixels.
    #[error("{}: the image is {width} x {height} pixels, which is nothing to show", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
        /// Pixels.
        width: u64,
        /// Pixels.
        height: u64,
    },
    /// More pixels than are accepted, or than the file can hold.
    #[error("{}: claims {width} x {height} pixels in {bytes} bytes of file\n{advice}", path.display())]
    Claim {
        /// The file.
        path: PathBuf,
        /// Pixels.
        width: u64,
        /// Pixels.
        height: u64,
        /// Size of the file.
        bytes: u64,
        /// What would be accepted.
        advice: String,
    },
    /// The file holds no colour where colour is needed.
    #[error("{}: has no R, G, B or Y channel (it has {found})\nuse a colour image", path.display())]
    NoColour {
        /// The file.
        path: PathBuf,
        /// Channels it has.
        found: String,
    },
    /// Parts of different sizes.
    #[error("{}: holds parts of different sizes\nuse a file whose parts cover the same pixels", .0.display())]
    Sizes(PathBuf),
    /// The file cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system or the encoder said.
        reason: String,
    },
}

/// Kinds of image files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Exr,
    Hdr,
    Png,
}

fn kind(path: &Path) -> Result<Kind, Error> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "exr" => Ok(Kind::Exr),
        "hdr" => Ok(Kind::Hdr),
        "png" => Ok(Kind::Png),
        _ => Err(Error::UnknownKind(path.to_owned())),
    }
}
