//! Headers are claims: they are weighed before memory is reserved for them.

use super::Error;
use std::path::Path;

/// Most pixels of an image: 32768 x 16384.
const MOST_PIXELS: u64 = 1 << 29;
/// Claims below this need no proof, bytes of decoded pixels.
const FREE_BYTES: u64 = 1 << 28;
/// More than any codec here packs into one byte (deflate: 1032).
const MOST_PER_BYTE: u64 = 2048;

/// Accepts an image of this size, if a file of this many bytes can hold it.
///
/// # Errors
/// If the image is empty, too large, or larger than its file can hold.
pub(super) fn weigh(
    path: &Path,
    [width, height]: [u64; 2],
    bytes_per_pixel: u64,
    file_bytes: u64,
) -> Result<(), Error> {
    if width == 0 || height == 0 {
        return Err(Error::Empty { path: path.to_owned(), width, height });
    }
    let pixels = width.saturating_mul(height);
    let decoded = pixels.saturating_mul(bytes_per_pixel);
    let advice = if pixels > MOST_PIXELS {
        "use an image of at most 32768 x 16384 pixels"
    } else if decoded > FREE_BYTES && decoded / MOST_PER_BYTE > file_bytes {
        "the file is too short for that many: fetch or export it again"
    } else {
        return Ok(());
    };
    let (path, advice) = (path.to_owned(), advice.to_owned());
    Err(Error::Claim { path, width, height, bytes: file_bytes, advice })
}
