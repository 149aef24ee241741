//! A block of a part: the rectangle that is packed at once, and its samples.

use super::header::{Channel, Part};

/// A block of a part: scanlines or a tile of the full resolution.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block<'a> {
    pub(super) part: usize,
    /// First pixel, in the coordinates of the windows.
    pub(super) min: [i64; 2],
    /// Width and height, pixels.
    pub(super) size_px: [u64; 2],
    pub(super) packed: &'a [u8],
}

impl Block<'_> {
    /// Bytes of the samples that the block holds.
    pub(super) fn unpacked_bytes(&self, part: &Part) -> usize {
        let bytes = |channel: &Channel| {
            let [columns, rows] = samples(self.min, self.size_px, channel.sampling);
            columns.saturating_mul(rows).saturating_mul(channel.sample.bytes())
        };
        part.channels.iter().map(bytes).fold(0, usize::saturating_add)
    }
}

/// How many samples of a channel lie in a rectangle: columns and rows.
pub(super) fn samples(min: [i64; 2], size_px: [u64; 2], sampling: [usize; 2]) -> [usize; 2] {
    [0, 1].map(|axis| {
        let step = sampling[axis] as i64;
        let multiples_below = |end: i64| (end + step - 1).div_euclid(step);
        (multiples_below(min[axis] + size_px[axis] as i64) - multiples_below(min[axis])) as usize
    })
}
