//! Radiance pictures (`.hdr`, `.pic`): what the header says of the pixels is
//! undone, so that what is returned is radiance.
//!
//! Source: Ward, "Real Pixels", Graphics Gems II, 1991; the file formats in the
//! Radiance Reference Manual (`filefmts`), "Picture files".

mod header;
mod scanline;

use super::claim::Claim;
use super::error::broken;
use super::{Error, Picture, colour};
use crate::{LayerName, Layers};
use header::Header;
use std::path::Path;

/// Reads a Radiance picture.
pub(super) fn read(path: &Path, bytes: &[u8]) -> Result<Picture, Error> {
    let (header, body) = Header::parse(path, bytes)?;
    let [width, height] = header.size_px.map(|n| n as usize);
    let [lines, length] = if header.columns_first { [width, height] } else { [height, width] };
    let claim =
        Claim { path, size_px: header.size_px.map(u64::from), file_bytes: bytes.len() as u64 };
    // The shortest scanline is one pixel and a run.
    claim.weigh(4 * (lines * length) as u64, body.len() as u64, length.max(1) as u64)?;
    let pixels = scanline::decode(body, lines, length).map_err(|reason| broken(path, reason))?;
    let mut data = vec![0.0; 3 * pixels.len()];
    for (place, pixel) in pixels.iter().enumerate() {
        let to = 3 * header.place(place / length, place % length);
        data[to..to + 3].copy_from_slice(&header.radiance(*pixel));
    }
    if let Some(matrix) = header.to_rec_709 {
        colour::transform(&mut data, &matrix);
    }
    let mut layers = Layers::new(header.size_px);
    layers.push(LayerName::Radiance, 3, data);
    let found = vec!["radiance".to_owned()];
    Ok(Picture { layers, found, warnings: header.warnings, ..Picture::default() })
}
