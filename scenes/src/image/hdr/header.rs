//! The text at the head of a Radiance picture.

use super::super::colour::{Chromaticities, rec_709_from_xyz};
use super::super::error::{broken, unsupported};
use super::Error;
use glam::DMat3;
use std::path::Path;

/// Longest header that is looked through, bytes.
const LONGEST: usize = 1 << 20;

/// What the text says of the pixels.
#[derive(Debug)]
pub(super) struct Header {
    /// Width and height, pixels.
    pub(super) size_px: [u32; 2],
    /// Scanlines are columns.
    pub(super) columns_first: bool,
    /// The first column of the file is the right one.
    right_to_left: bool,
    /// The first row of the file is the lowest.
    bottom_up: bool,
    /// What pixels were multiplied by: all EXPOSURE and COLORCORR lines, R, G, B.
    multiplied_by: [f64; 3],
    /// To linear Rec. 709, where pixels are something else.
    pub(super) to_rec_709: Option<DMat3>,
    /// What is not obeyed.
    pub(super) warnings: Vec<String>,
}

/// The text while it is read.
#[derive(Default)]
struct Lines {
    exposure: Option<f64>,
    correction: Option<[f64; 3]>,
    primaries: Option<Chromaticities>,
    is_xyz: bool,
    warnings: Vec<String>,
}

impl Header {
    /// The header and the bytes after it.
    pub(super) fn parse<'a>(path: &Path, bytes: &'a [u8]) -> Result<(Self, &'a [u8]), Error> {
        let cut = || broken(path, "its header does not end");
        let mut rest = bytes;
        let mut line = || {
            let end = rest.iter().take(LONGEST).position(|byte| *byte == b'\n')?;
            let (line, after) = (&rest[..end], &rest[end + 1..]);
            rest = after;
            Some(String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line)).into_owned())
        };
        // The first line is `#?` and the name of a program.
        line().ok_or_else(cut)?;
        let mut lines = Lines::default();
        loop {
            let text = line().ok_or_else(cut)?;
            if text.is_empty() {
                break;
            }
            lines.obey(path, &text)?;
        }
        let resolution = line().ok_or_else(cut)?;
        let header = lines.finish(path, &resolution)?;
        Ok((header, rest))
    }

    /// Where a pixel of the file belongs: index in rows from the top.
    pub(super) fn place(&self, line: usize, along: usize) -> usize {
        let [width, height] = self.size_px.map(|n| n as usize);
        let (x, y) = if self.columns_first { (line, along) } else { (along, line) };
        let x = if self.right_to_left { width - 1 - x } else { x };
        let y = if self.bottom_up { height - 1 - y } else { y };
        y * width + x
    }

    /// The three values of a pixel: mantissa / 256 · 2^(exponent - 128), divided
    /// by what they were multiplied by.
    pub(super) fn radiance(&self, [r, g, b, exponent]: [u8; 4]) -> [f64; 3] {
        if exponent == 0 {
            return [0.0; 3];
        }
        let scale = f64::from(i32::from(exponent) - 136).exp2();
        let [by_r, by_g, by_b] = self.multiplied_by;
        [(r, by_r), (g, by_g), (b, by_b)].map(|(value, by)| f64::from(value) * scale / by)
    }
}

impl Lines {
    /// Takes one `NAME=value`. Others, comments, and lines that are indented (they
    /// are of images that this one was made of) say nothing of its pixels.
    fn obey(&mut self, path: &Path, text: &str) -> Result<(), Error> {
        let Some((name, value)) = text.split_once('=') else { return Ok(()) };
        match name.trim_end() {
            "FORMAT" => match value.trim() {
                "32-bit_rle_rgbe" => self.is_xyz = false,
                "32-bit_rle_xyze" => self.is_xyz = true,
                other => {
                    let advice = "use 32-bit_rle_rgbe or 32-bit_rle_xyze";
                    return Err(unsupported(path, format!("its pixels are {other}"), advice));
                }
            },
            "EXPOSURE" => {
                let [value] = numbers(path, text, value, |v| v > 0.0)?;
                self.exposure = Some(self.exposure.unwrap_or(1.0) * value);
            }
            "COLORCORR" => {
                let by: [f64; 3] = numbers(path, text, value, |v| v > 0.0)?;
                let old = self.correction.unwrap_or([1.0; 3]);
                self.correction = Some([0, 1, 2].map(|i| old[i] * by[i]));
            }
            "PRIMARIES" => {
                let xy = numbers(path, text, value, |v| v.abs() < 10.0)?;
                self.primaries = Some(Chromaticities::from_array(xy));
            }
            "PIXASPECT" => {
                let [aspect] = numbers(path, text, value, |v| v > 0.0)?;
                if (aspect - 1.0).abs() > 1e-3 {
                    let warning = format!("{text}: pixels are taken as they are, not stretched");
                    self.warnings.push(warning);
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn finish(self, path: &Path, resolution: &str) -> Result<Header, Error> {
        let mut warnings = self.warnings;
        let to_rec_709 = match self.primaries {
            _ if self.is_xyz => Some(rec_709_from_xyz()),
            Some(primaries) if !primaries.is_rec_709() => {
                let matrix = primaries.rec_709_from_rgb();
                if matrix.is_none() {
                    warnings
                        .push("PRIMARIES do not span the colours; Rec. 709 is taken".to_owned());
                }
                matrix
            }
            _ => None,
        };
        let exposure = self.exposure.unwrap_or(1.0);
        let multiplied_by = self.correction.unwrap_or([1.0; 3]).map(|by| by * exposure);
        let [first, second] = axes(resolution).ok_or_else(|| {
            broken(path, format!("`{resolution}` is no size such as -Y 512 +X 1024"))
        })?;
        let columns_first = first.0 == 'X';
        let (x, y) = if columns_first { (first, second) } else { (second, first) };
        Ok(Header {
            size_px: [x.2, y.2],
            columns_first,
            right_to_left: x.1 == '-',
            bottom_up: y.1 == '+',
            multiplied_by,
            to_rec_709,
            warnings,
        })
    }
}

/// The numbers of a line, each of which has to be usable.
fn numbers<const N: usize>(
    path: &Path,
    line: &str,
    value: &str,
    usable: impl Fn(f64) -> bool,
) -> Result<[f64; N], Error> {
    let found: Result<Vec<f64>, _> = value.split_whitespace().map(str::parse).collect();
    let found = found.ok().and_then(|found| <[f64; N]>::try_from(found).ok());
    let found = found.filter(|found| found.iter().all(|v| v.is_finite() && usable(*v)));
    found.ok_or_else(|| broken(path, format!("`{line}` in its header means nothing")))
}

/// Axis, sign and length of both directions: `-Y 512 +X 1024`, slow one first.
fn axes(text: &str) -> Option<[(char, char, u32); 2]> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let [first, length, second, other] = words[..] else { return None };
    let one = |word: &str, length: &str| {
        let mut letters = word.chars();
        let (sign, axis) = (letters.next()?, letters.next()?);
        let sound = matches!(sign, '+' | '-') && letters.next().is_none();
        sound.then_some((axis, sign, length.parse().ok()?))
    };
    let (first, second) = (one(first, length)?, one(second, other)?);
    matches!((first.0, second.0), ('X', 'Y') | ('Y', 'X')).then_some([first, second])
}
