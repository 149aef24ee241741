//! Portable float maps: `PF` (colour) or `Pf` (grey), width, height, a scale whose
//! sign is the byte order, then rows from the bottom.
//!
//! Source: Debevec, "PFM Portable FloatMap Image Format", pauldebevec.com/Research/HDR/PFM.

use super::claim::Claim;
use super::error::broken;
use super::{Error, Picture};
use crate::{LayerName, Layers};
use std::path::Path;

/// Reads a portable float map.
pub(super) fn read(path: &Path, bytes: &[u8]) -> Result<Picture, Error> {
    let header = Header::parse(bytes).ok_or_else(|| broken(path, "its header means nothing"))?;
    let Header { channels, size_px, scale, end } = header;
    let body = &bytes[end..];
    let size = size_px.map(u64::from);
    let claim = Claim { path, size_px: size, file_bytes: bytes.len() as u64 };
    let needed = (size[0] * size[1]).saturating_mul(4 * channels as u64);
    claim.weigh(needed, body.len() as u64, 1)?;
    // The line may end with CR LF.
    let body = if body.len() as u64 == needed + 1 { &body[1..] } else { body };
    if (body.len() as u64) < needed {
        return Err(broken(path, format!("it has {} of {needed} bytes of pixels", body.len())));
    }
    let number = |bytes: &[u8; 4]| {
        f64::from(if scale < 0.0 { f32::from_le_bytes(*bytes) } else { f32::from_be_bytes(*bytes) })
    };
    let times = if channels == 1 { 3 } else { 1 };
    let row_bytes = 4 * channels * size_px[0] as usize;
    let mut data = Vec::new();
    for row in body[..needed as usize].chunks_exact(row_bytes).rev() {
        let values = row.as_chunks::<4>().0.iter().map(number);
        // Grey is the same three times.
        data.extend(values.flat_map(|value| std::iter::repeat_n(value, times)));
    }
    let mut picture = Picture { found: vec!["radiance".to_owned()], ..Picture::default() };
    if scale.abs() != 1.0 {
        picture.warnings.push(format!(
            "its scale is {}, of which programs make different things: the samples are taken as \
             they are",
            scale.abs()
        ));
    }
    picture.layers = Layers::new(size_px);
    picture.layers.push(LayerName::Radiance, 3, data);
    Ok(picture)
}

struct Header {
    channels: usize,
    size_px: [u32; 2],
    /// Below 0 for little endian.
    scale: f64,
    /// Where the pixels begin.
    end: usize,
}

impl Header {
    fn parse(bytes: &[u8]) -> Option<Self> {
        let mut words = Vec::new();
        let mut start = 0;
        let mut end = 0;
        while words.len() < 4 {
            let is_space = bytes.get(end)?.is_ascii_whitespace();
            if is_space {
                if end > start {
                    words.push(std::str::from_utf8(&bytes[start..end]).ok()?);
                }
                start = end + 1;
            }
            end += 1;
        }
        let channels = match words[0] {
            "PF" => 3,
            "Pf" => 1,
            _ => return None,
        };
        let size_px = [words[1].parse().ok()?, words[2].parse().ok()?];
        let scale: f64 = words[3].parse().ok()?;
        let sound = scale.is_finite() && scale != 0.0;
        sound.then_some(Self { channels, size_px, scale, end })
    }
}
