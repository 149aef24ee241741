//! Headers are claims: they are weighed before memory is reserved for them.

use super::Error;
use std::path::Path;

/// Most pixels of an image: 32768 x 16384.
const MOST_PIXELS: u64 = 1 << 29;
/// Claims below this need no proof, bytes of decoded pixels.
pub(super) const FREE_BYTES: u64 = 1 << 28;

/// An image as its header describes it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Claim<'a> {
    pub(super) path: &'a Path,
    /// Width and height, pixels.
    pub(super) size_px: [u64; 2],
    /// Size of the file, bytes.
    pub(super) file_bytes: u64,
}

impl Claim<'_> {
    /// Accepts the size as such.
    ///
    /// # Errors
    /// If the image is empty or larger than any that is accepted.
    pub(super) fn size(&self) -> Result<(), Error> {
        let [width, height] = self.size_px;
        if width == 0 || height == 0 {
            return Err(Error::Empty { path: self.path.to_owned(), width, height });
        }
        if width.saturating_mul(height) > MOST_PIXELS {
            return Err(self.refused("use an image of at most 32768 x 16384 pixels"));
        }
        Ok(())
    }

    /// Accepts an image whose file holds `packed` bytes of pixels, which a codec
    /// that makes at most `most_per_byte` of one unpacks to `decoded`.
    ///
    /// # Errors
    /// Those of [`Claim::size`], and if the file cannot hold so many pixels.
    pub(super) fn weigh(&self, decoded: u64, packed: u64, most_per_byte: u64) -> Result<(), Error> {
        self.size()?;
        if decoded > FREE_BYTES && decoded / most_per_byte > packed {
            return Err(self.too_short());
        }
        Ok(())
    }

    /// The file cannot hold what it claims.
    pub(super) fn too_short(&self) -> Error {
        self.refused("the file is too short for that many: fetch or export it again")
    }

    /// Refuses the claim with this advice.
    pub(super) fn refused(&self, advice: &str) -> Error {
        let ([width, height], bytes) = (self.size_px, self.file_bytes);
        let (path, advice) = (self.path.to_owned(), advice.to_owned());
        Error::Claim { path, width, height, bytes, advice }
    }
}
