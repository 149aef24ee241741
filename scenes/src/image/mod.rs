//! Image files: what OpenEXR, Radiance, PFM, PNG and others hold, and layers to
//! OpenEXR and PNG.
//!
//! What a file says of its pixels is obeyed or said, never dropped. Nothing is
//! half written: files appear under their name when they are whole. Nothing is
//! allocated on the word of a header that the file cannot keep.

mod claim;
mod colour;
mod error;
mod exr;
mod hdr;
mod kind;
mod pfm;
mod picture;
mod raster;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub use error::Error;
pub use picture::{Alpha, Encoding, Picture};
pub use read::{file_of, open, read, read_lat_long};
pub use write::{Preview, ToneMap, write_exr, write_exr_with, write_png};
