//! The codecs of OpenEXR. The `exr` crate unpacks PIZ, PXR24, B44 and DWA; the
//! simple ones are unpacked here, because the crate knows no subsampled channels.
//!
//! Source: "Technical Introduction to OpenEXR", openexr.com, "Data Compression".

use super::block::{Block, samples};
use super::header::{Channel, Part, Sample};
use exr::compression::Compression;
use exr::math::{RoundingMode, Vec2};
use exr::meta::BlockDescription;
use exr::meta::attribute::{
    ChannelDescription, IntegerBounds, LevelMode, LineOrder, SampleType, Text, TileDescription,
};
use exr::meta::header::Header;
use std::io::Read;

/// How the samples of a part are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Codec {
    Raw,
    Rle,
    Zip { lines: u64 },
    Piz,
    Pxr24,
    B44,
    Dwa { lines: u64 },
}

impl Codec {
    /// The codec of that number, or the name of one that is not read.
    pub(super) fn of(number: u8) -> Result<Self, String> {
        Ok(match number {
            0 => Self::Raw,
            1 => Self::Rle,
            2 => Self::Zip { lines: 1 },
            3 => Self::Zip { lines: 16 },
            4 => Self::Piz,
            5 => Self::Pxr24,
            6 | 7 => Self::B44,
            8 => Self::Dwa { lines: 32 },
            9 => Self::Dwa { lines: 256 },
            10 | 11 => return Err("HTJ2K".to_owned()),
            13 => return Err("ZSTD".to_owned()),
            other => return Err(format!("number {other}")),
        })
    }

    /// Scanlines in a block.
    pub(super) fn lines(self) -> u64 {
        match self {
            Self::Raw | Self::Rle => 1,
            Self::Zip { lines } | Self::Dwa { lines } => lines,
            Self::Pxr24 => 16,
            Self::Piz | Self::B44 => 32,
        }
    }

    /// More bytes than the codec makes of one: deflate 1032, of which PXR24 keeps
    /// three in four; runs of 255 Huffman codes; 16 halves in 3 bytes; and 64
    /// samples in the first coefficient of a block that is deflated again.
    pub(super) fn most_per_byte(self) -> u64 {
        match self {
            Self::Raw => 1,
            Self::Rle => 64,
            Self::Zip { .. } => 1033,
            Self::Piz => 1024,
            Self::Pxr24 => 1377,
            Self::B44 => 11,
            Self::Dwa { .. } => 1 << 17,
        }
    }

    /// The samples of a block: row by row and, in each row, channel by channel.
    pub(super) fn unpack(self, part: &Part, block: &Block) -> Result<Vec<u8>, String> {
        let expected = block.unpacked_bytes(part);
        if block.packed.len() == expected {
            return Ok(block.packed.to_vec());
        }
        let unpacked = match self {
            Self::Raw => block.packed.to_vec(),
            Self::Rle => sorted(&runs(block.packed, expected).ok_or("its runs are broken")?),
            Self::Zip { .. } => {
                let mut bytes = Vec::new();
                let inflater = flate2::read::ZlibDecoder::new(block.packed);
                let inflated = inflater.take(expected as u64 + 1).read_to_end(&mut bytes);
                inflated.map_err(|error| error.to_string())?;
                sorted(&bytes)
            }
            Self::B44 if part.channels.iter().any(is_subsampled) => b44(part, block)?,
            _ => self.by_crate(&part.channels, block.min, block.size_px, block.packed)?,
        };
        if unpacked.len() != expected {
            return Err(format!("a block has {} bytes instead of {expected}", unpacked.len()));
        }
        Ok(unpacked)
    }

    fn by_crate(
        self,
        channels: &[Channel],
        min: [i64; 2],
        size_px: [u64; 2],
        packed: &[u8],
    ) -> Result<Vec<u8>, String> {
        let compression = match self {
            Self::Piz => Compression::PIZ,
            Self::Pxr24 => Compression::PXR24,
            Self::B44 => Compression::B44,
            _ => Compression::DWAA(None),
        };
        let size = Vec2(size_px[0] as usize, size_px[1] as usize);
        let list = channels.iter().map(description).collect();
        let tile_size = size;
        let tile = TileDescription {
            tile_size,
            level_mode: LevelMode::Singular,
            rounding_mode: RoundingMode::Down,
        };
        let mut header = Header::new(Text::from(""), size, list).with_encoding(
            compression,
            BlockDescription::Tiles(tile),
            LineOrder::Increasing,
        );
        // The crate counts every channel in full; the mean over a block is what
        // its codecs need.
        let per_pixel = |channel: &Channel| {
            let [columns, rows] = samples(min, size_px, channel.sampling);
            columns * rows * channel.sample.bytes()
        };
        let bytes: usize = channels.iter().map(per_pixel).sum();
        if !bytes.is_multiple_of(size.area()) {
            return Err("its subsampled channels do not fill whole pixels".to_owned());
        }
        header.channels.bytes_per_pixel = bytes / size.area();
        let position = min.map(|at| i32::try_from(at).map_err(|error| error.to_string()));
        let [x, y] = position;
        let section = IntegerBounds { position: Vec2(x?, y?), size };
        compression
            .decompress_image_section_from_le(&header, packed.to_vec(), section, false)
            .map_err(|error| error.to_string())
    }
}

fn is_subsampled(channel: &Channel) -> bool {
    channel.sampling != [1, 1]
}

fn description(channel: &Channel) -> ChannelDescription {
    let sample_type = match channel.sample {
        Sample::Uint => SampleType::U32,
        Sample::Half => SampleType::F16,
        Sample::Float => SampleType::F32,
    };
    let name = Text::new_or_none(&channel.name).unwrap_or_else(|| Text::from("?"));
    ChannelDescription {
        name,
        sample_type,
        quantize_linearly: channel.is_linear,
        sampling: Vec2(channel.sampling[0], channel.sampling[1]),
    }
}

/// Runs (count + 1 times the next byte) and, where the count is negative, that
/// many bytes as they are.
fn runs(packed: &[u8], expected: usize) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut rest = packed;
    while let [count, after @ ..] = rest {
        let count = *count as i8;
        if count < 0 {
            let (literal, after) = after.split_at_checked(usize::from(count.unsigned_abs()))?;
            bytes.extend_from_slice(literal);
            rest = after;
        } else {
            let (value, after) = after.split_first()?;
            bytes.resize(bytes.len() + count as usize + 1, *value);
            rest = after;
        }
        if bytes.len() > expected {
            return None;
        }
    }
    Some(bytes)
}

/// Undoes differences, then puts the halves of the buffer into each other.
fn sorted(bytes: &[u8]) -> Vec<u8> {
    let mut summed = bytes.to_vec();
    for at in 1..summed.len() {
        summed[at] = summed[at - 1].wrapping_add(summed[at]).wrapping_sub(128);
    }
    let (first, second) = summed.split_at(summed.len().div_ceil(2));
    let mut sorted = vec![0; summed.len()];
    sorted.iter_mut().step_by(2).zip(first).for_each(|(to, from)| *to = *from);
    sorted.iter_mut().skip(1).step_by(2).zip(second).for_each(|(to, from)| *to = *from);
    sorted
}

/// B44 packs channel after channel: each is cut out and unpacked as an image of
/// its own size, then the rows are put into each other.
fn b44(part: &Part, block: &Block) -> Result<Vec<u8>, String> {
    let mut rest = block.packed;
    let mut planes = Vec::new();
    for channel in &part.channels {
        let [columns, rows] = samples(block.min, block.size_px, channel.sampling);
        let raw = columns * rows * channel.sample.bytes();
        let length = if channel.sample == Sample::Half {
            let cells = columns.div_ceil(4) * rows.div_ceil(4);
            // A cell of one value takes 3 bytes and says so in the third.
            (0..cells).try_fold(0, |at, _| {
                let third = rest.get(at + 2)?;
                Some(at + if *third >= 13 << 2 { 3 } else { 14 })
            })
        } else {
            Some(raw)
        };
        let cut = length.and_then(|length| rest.split_at_checked(length));
        let (packed, after) = cut.ok_or("a block is cut off")?;
        rest = after;
        let alone = [Channel { sampling: [1, 1], ..channel.clone() }];
        let size_px = [columns as u64, rows as u64];
        let plane = if packed.len() == raw {
            packed.to_vec()
        } else {
            Codec::B44.by_crate(&alone, [0, 0], size_px, packed)?
        };
        planes.push(plane.into_iter());
    }
    let mut unpacked = Vec::new();
    for y in block.min[1]..block.min[1] + block.size_px[1] as i64 {
        for (channel, plane) in part.channels.iter().zip(&mut planes) {
            if y.rem_euclid(channel.sampling[1] as i64) == 0 {
                let [columns, _] = samples(block.min, block.size_px, channel.sampling);
                unpacked.extend(plane.take(columns * channel.sample.bytes()));
            }
        }
    }
    Ok(unpacked)
}
