//! The headers of an OpenEXR file: what each part says of its pixels.
//!
//! Source: "OpenEXR File Layout", openexr.com/en/latest/OpenEXRFileLayout.html.

use super::super::colour::Chromaticities;

/// Longest name or string that is taken, bytes.
const LONGEST_NAME: usize = 255;
/// Most channels and parts that a file is expected to have.
const MOST: usize = 4096;

/// Inclusive bounds in pixels; x to the right, y downwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Window {
    pub(super) min: [i64; 2],
    pub(super) max: [i64; 2],
}

impl Window {
    /// Width and height, pixels; 0 where a bound is below the other.
    pub(super) fn size_px(&self) -> [u64; 2] {
        [0, 1].map(|axis| (self.max[axis] - self.min[axis] + 1).max(0) as u64)
    }

    /// Number of pixels.
    pub(super) fn pixels(&self) -> u64 {
        let [width, height] = self.size_px();
        width.saturating_mul(height)
    }
}

/// How the numbers of a channel are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sample {
    Uint,
    Half,
    Float,
}

impl Sample {
    /// Bytes of a number.
    pub(super) fn bytes(self) -> usize {
        if self == Self::Half { 2 } else { 4 }
    }
}

/// One channel of a part.
#[derive(Clone, Debug)]
pub(super) struct Channel {
    pub(super) name: String,
    pub(super) sample: Sample,
    /// Whether lossy codecs count in equal steps.
    pub(super) is_linear: bool,
    /// Every how many pixels, in x and y, there is a sample.
    pub(super) sampling: [usize; 2],
}

/// Tiles instead of scanlines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tiles {
    pub(super) size_px: [u64; 2],
}

/// One part (a file without parts is one).
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    pub(super) name: String,
    pub(super) channels: Vec<Channel>,
    /// Number of the codec, as in the file.
    pub(super) compression: u8,
    pub(super) data: Window,
    pub(super) display: Window,
    pub(super) tiles: Option<Tiles>,
    pub(super) is_deep: bool,
    /// Blocks of the part, all levels; absent in files of one part.
    pub(super) chunk_count: Option<u64>,
    pub(super) chromaticities: Option<Chromaticities>,
    /// The part holds the six faces of a cube.
    pub(super) is_cube: bool,
}

/// The headers of a file and where they end.
#[derive(Debug)]
pub(super) struct Headers {
    pub(super) parts: Vec<Part>,
    /// Blocks tell their part.
    pub(super) is_multi_part: bool,
    /// Where the tables of offsets begin.
    pub(super) end: usize,
}

/// The version that a file says it has; 1 and 2 are read.
pub(super) fn version(bytes: &[u8]) -> Option<u8> {
    bytes.get(4).copied()
}

/// A place in the bytes of a file.
pub(super) struct Cursor<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let taken = self.bytes.get(self.at..self.at.checked_add(count)?)?;
        self.at += count;
        Some(taken)
    }

    pub(super) fn u8(&mut self) -> Option<u8> {
        self.take(1).map(|byte| byte[0])
    }

    pub(super) fn i32(&mut self) -> Option<i32> {
        Some(i32::from_le_bytes(self.take(4)?.try_into().ok()?))
    }

    pub(super) fn u64(&mut self) -> Option<u64> {
        Some(u64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }

    fn f32(&mut self) -> Option<f32> {
        Some(f32::from_le_bytes(self.take(4)?.try_into().ok()?))
    }

    /// Text that ends with 0.
    fn text(&mut self) -> Option<String> {
        let rest = self.bytes.get(self.at..)?;
        let length = rest.iter().take(LONGEST_NAME + 1).position(|byte| *byte == 0)?;
        let text = String::from_utf8_lossy(&rest[..length]).into_owned();
        self.at += length + 1;
        Some(text)
    }

    fn window(&mut self) -> Option<Window> {
        let [x, y, right, bottom] = [self.i32()?, self.i32()?, self.i32()?, self.i32()?];
        Some(Window { min: [x.into(), y.into()], max: [right.into(), bottom.into()] })
    }
}

impl Headers {
    /// Parses all headers; an error says which thing is missing.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, String> {
        let mut cursor = Cursor { bytes, at: 4 };
        let version = cursor.i32().ok_or("it ends before its version")? as u32;
        let [is_tiled, is_deep, is_multi_part] = [9, 11, 12].map(|bit| version >> bit & 1 == 1);
        let mut parts = Vec::new();
        loop {
            let mut part = part(&mut cursor, is_tiled)?;
            part.is_deep |= is_deep && !is_multi_part;
            parts.push(part);
            if !is_multi_part {
                break;
            }
            if bytes.get(cursor.at) == Some(&0) {
                cursor.at += 1;
                break;
            }
            if parts.len() > MOST {
                return Err(format!("it has more than {MOST} parts"));
            }
        }
        Ok(Self { parts, is_multi_part, end: cursor.at })
    }
}

/// The attributes of one header, up to the empty name that ends it.
fn part(cursor: &mut Cursor, is_tiled: bool) -> Result<Part, String> {
    let mut part = Part::default();
    let (mut has_data, mut has_display, mut has_compression) = (false, false, false);
    let mut kind = None;
    loop {
        let name = cursor.text().ok_or("its header ends early")?;
        if name.is_empty() {
            break;
        }
        let cut = || format!("its header ends in the attribute {name}");
        let of = cursor.text().ok_or_else(cut)?;
        let size = cursor.i32().and_then(|size| usize::try_from(size).ok()).ok_or_else(cut)?;
        let value = cursor.take(size).ok_or_else(cut)?;
        let mut value = Cursor { bytes: value, at: 0 };
        let bad = || format!("its attribute {name} means nothing");
        match (name.as_str(), of.as_str()) {
            ("channels", "chlist") => part.channels = channels(&mut value).ok_or_else(bad)?,
            ("compression", "compression") => {
                (part.compression, has_compression) = (value.u8().ok_or_else(bad)?, true);
            }
            ("dataWindow", "box2i") => {
                (part.data, has_data) = (value.window().ok_or_else(bad)?, true);
            }
            ("displayWindow", "box2i") => {
                (part.display, has_display) = (value.window().ok_or_else(bad)?, true);
            }
            ("tiles", "tiledesc") => part.tiles = Some(tiles(&mut value).ok_or_else(bad)?),
            ("name", "string") => part.name = string(&value),
            ("type", "string") => kind = Some(string(&value)),
            ("chunkCount", "int") => {
                part.chunk_count = value.i32().and_then(|count| u64::try_from(count).ok());
            }
            ("chromaticities", "chromaticities") => {
                let mut xy = [0.0; 8];
                for number in &mut xy {
                    *number = f64::from(value.f32().ok_or_else(bad)?);
                }
                part.chromaticities = Some(Chromaticities::from_array(xy));
            }
            ("envmap", "envmap") => part.is_cube = value.u8() == Some(1),
            _ => {}
        }
    }
    part.is_deep = kind.as_deref().is_some_and(|kind| kind.starts_with("deep"));
    let is_tiled = kind.map_or(is_tiled, |kind| kind.ends_with("tile") || kind == "tiledimage");
    if !is_tiled {
        part.tiles = None;
    }
    for (has, what) in [
        (has_data, "dataWindow"),
        (has_display, "displayWindow"),
        (has_compression, "compression"),
        (!part.channels.is_empty(), "channels"),
        (part.tiles.is_some() || !is_tiled, "tiles"),
    ] {
        if !has {
            return Err(format!("its header has no attribute {what}"));
        }
    }
    Ok(part)
}

fn string(value: &Cursor) -> String {
    String::from_utf8_lossy(value.bytes).trim_end_matches('\0').to_owned()
}

fn tiles(value: &mut Cursor) -> Option<Tiles> {
    let size_px = [value.i32()?, value.i32()?];
    let sound = size_px.iter().all(|side| *side > 0);
    sound.then(|| Tiles { size_px: size_px.map(|side| side as u64) })
}

fn channels(value: &mut Cursor) -> Option<Vec<Channel>> {
    let mut list = Vec::new();
    loop {
        let name = value.text()?;
        if name.is_empty() {
            return Some(list);
        }
        let sample = match value.i32()? {
            0 => Sample::Uint,
            1 => Sample::Half,
            2 => Sample::Float,
            _ => return None,
        };
        let is_linear = value.take(4)?[0] != 0;
        let sampling = [value.i32()?, value.i32()?];
        if sampling.iter().any(|step| !(1..=1 << 16).contains(step)) || list.len() >= MOST {
            return None;
        }
        list.push(Channel { name, sample, is_linear, sampling: sampling.map(|n| n as usize) });
    }
}
