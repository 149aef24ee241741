//! Where the blocks of a part lie in the file: every block is found, and weighed
//! against what its codec can pack, before memory is reserved for pixels.

use super::super::Error;
use super::super::claim::{Claim, FREE_BYTES};
use super::super::error::broken;
use super::block::Block;
use super::codec::Codec;
use super::header::{Cursor, Headers, Part};

/// Finds all blocks of the full resolution, part after part.
///
/// # Errors
/// If one is missing or lies outside the file, or if the file cannot hold what
/// its headers claim.
pub(super) fn locate<'a>(
    claim: &Claim,
    headers: &Headers,
    codecs: &[Codec],
    bytes: &'a [u8],
) -> Result<Vec<Block<'a>>, Error> {
    let whole = |part: &Part| {
        let (min, size_px) = (part.data.min, part.data.size_px());
        Block { part: 0, min, size_px, packed: &[] }.unpacked_bytes(part)
    };
    let claimed = headers.parts.iter().map(whole).fold(0, usize::saturating_add);
    let needs_proof = claimed as u64 > FREE_BYTES;
    let short = |reason: String| {
        if needs_proof { claim.too_short() } else { broken(claim.path, reason) }
    };
    let mut blocks = Vec::new();
    let (mut table, mut packed) = (headers.end, 0);
    for (number, part) in headers.parts.iter().enumerate() {
        let grid = Grid::new(part, codecs[number]);
        let count = grid.count();
        let entries = part.chunk_count.unwrap_or(count).max(count);
        let end = usize::try_from(entries).ok().and_then(|n| table.checked_add(n.checked_mul(8)?));
        let end = end.filter(|end| *end <= bytes.len());
        let end = end.ok_or_else(|| short("its table of blocks is not whole".to_owned()))?;
        let mut seen = vec![false; count as usize];
        let mut cursor = Cursor { bytes, at: table };
        for place in 0..count {
            let offset = cursor.u64().unwrap_or_default();
            let found = grid.block(headers.is_multi_part, number, bytes, offset);
            let (block, _) = found
                .filter(|(_, index)| !std::mem::replace(&mut seen[*index], true))
                .ok_or_else(|| short(format!("block {place} of {count} is missing")))?;
            let most = codecs[number].most_per_byte().saturating_mul(block.packed.len() as u64);
            packed += block.packed.len();
            let too_much = block.unpacked_bytes(part) as u64 > most || packed > bytes.len();
            if too_much && needs_proof {
                return Err(claim.too_short());
            }
            blocks.push(block);
        }
        table = end;
    }
    Ok(blocks)
}

/// How a part is cut into blocks.
struct Grid<'p> {
    part: &'p Part,
    /// Width and height of a block, pixels.
    block_px: [u64; 2],
    /// Blocks in x and y.
    blocks: [u64; 2],
}

impl<'p> Grid<'p> {
    fn new(part: &'p Part, codec: Codec) -> Self {
        let size = part.data.size_px();
        let block_px = part.tiles.map_or([size[0].max(1), codec.lines()], |tiles| tiles.size_px);
        let blocks = [0, 1].map(|axis| size[axis].div_ceil(block_px[axis]));
        Self { part, block_px, blocks }
    }

    fn count(&self) -> u64 {
        self.blocks[0].saturating_mul(self.blocks[1])
    }

    /// The block at an offset of the file, and its number in the grid.
    fn block<'a>(
        &self,
        is_multi_part: bool,
        number: usize,
        bytes: &'a [u8],
        offset: u64,
    ) -> Option<(Block<'a>, usize)> {
        let mut cursor = Cursor { bytes, at: usize::try_from(offset).ok()? };
        if is_multi_part && usize::try_from(cursor.i32()?).ok()? != number {
            return None;
        }
        let place = if self.part.tiles.is_some() {
            let place = [cursor.i32()?, cursor.i32()?];
            let level = [cursor.i32()?, cursor.i32()?];
            if level != [0, 0] {
                return None;
            }
            place.map(i64::from)
        } else {
            let row = i64::from(cursor.i32()?) - self.part.data.min[1];
            let lines = self.block_px[1] as i64;
            [0, if row % lines == 0 { row / lines } else { -1 }]
        };
        let place = [u64::try_from(place[0]).ok()?, u64::try_from(place[1]).ok()?];
        if place[0] >= self.blocks[0] || place[1] >= self.blocks[1] {
            return None;
        }
        let packed = usize::try_from(cursor.i32()?).ok()?;
        let packed = cursor.take(packed)?;
        let size = self.part.data.size_px();
        let first = [0, 1].map(|axis| place[axis] * self.block_px[axis]);
        let size_px = [0, 1].map(|axis| self.block_px[axis].min(size[axis] - first[axis]));
        let min = [0, 1].map(|axis| self.part.data.min[axis] + first[axis] as i64);
        let index = (place[1] * self.blocks[0] + place[0]) as usize;
        Some((Block { part: number, min, size_px, packed }, index))
    }
}
