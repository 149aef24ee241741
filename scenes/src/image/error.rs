//! Why an image could not be read or written.

use std::path::{Path, PathBuf};

/// What can be read, for errors that refuse something else.
pub(super) const KINDS: &str = "OpenEXR (.exr), Radiance (.hdr, .pic), PFM, PNG, TIFF, JPEG, WebP, \
     TGA, BMP, PPM or QOI";

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
    /// Neither name nor content tell the kind of image.
    #[error("{}: not a known kind of image\nuse {KINDS}", .0.display())]
    UnknownKind(PathBuf),
    /// The content is broken or cut off.
    #[error("{}: {reason}\nfetch or export the file again: it is broken or cut off", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What the decoder said.
        reason: String,
    },
    /// A sound file of a form that is not read.
    #[error("{}: {what}\n{advice}", path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What is not read.
        what: String,
        /// What would be.
        advice: String,
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
    #[error(
        "{}: has no R, G, B or Y channel (it has {found})\nuse a colour image, or choose one of \
         its layers with FILE:LAYER", path.display()
    )]
    NoColour {
        /// The file.
        path: PathBuf,
        /// Layers it has.
        found: String,
    },
    /// Several layers could be the image.
    #[error(
        "{}: several layers could be the image: {}\nchoose one: {}:{}",
        path.display(), layers.join(", "), path.display(),
        layers.first().map_or("LAYER", String::as_str)
    )]
    Ambiguous {
        /// The file.
        path: PathBuf,
        /// Layers with colours.
        layers: Vec<String>,
    },
    /// The layer that was asked for is not there.
    #[error("{}: has no layer {layer}\nit has {found}", path.display())]
    NoLayer {
        /// The file.
        path: PathBuf,
        /// Asked for.
        layer: String,
        /// Layers it has.
        found: String,
    },
    /// The file cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system or the encoder said.
        reason: String,
    },
}

/// An error about the content of a file.
pub(super) fn broken(path: &Path, reason: impl ToString) -> Error {
    Error::Broken { path: path.to_owned(), reason: reason.to_string() }
}

/// An error about a sound file that is not read, with what would be.
pub(super) fn unsupported(path: &Path, what: impl Into<String>, advice: &str) -> Error {
    Error::Unsupported { path: path.to_owned(), what: what.into(), advice: advice.to_owned() }
}
