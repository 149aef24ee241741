//! The scanlines of a Radiance picture: flat, and both run-length codes.

/// Lengths that the newer run-length code is used for.
const NEWER_CODE: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// Red, green, blue mantissa and the exponent.
pub(super) type Rgbe = [u8; 4];

/// Decodes `lines` scanlines of `length` pixels. Memory grows with what the file
/// really holds.
pub(super) fn decode(body: &[u8], lines: usize, length: usize) -> Result<Vec<Rgbe>, String> {
    let mut bytes = Bytes(body);
    let mut pixels = Vec::new();
    for line in 0..lines {
        let end = pixels.len() + length;
        let read = if bytes.begins_newer_code(length) {
            newer(&mut bytes, length, &mut pixels)
        } else {
            older(&mut bytes, end, &mut pixels)
        };
        read.ok_or_else(|| format!("scanline {line} of {lines} is not whole"))?;
    }
    Ok(pixels)
}

/// What is left of the file.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take(&mut self, count: usize) -> Option<&[u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1).map(|byte| byte[0])
    }

    /// The newer code begins with 2, 2 and the length, whose first bit is 0.
    fn begins_newer_code(&self, length: usize) -> bool {
        NEWER_CODE.contains(&length) && matches!(self.0, [2, 2, high, ..] if high & 0x80 == 0)
    }
}

/// The four components one after another, each in runs (count above 128) and
/// literal bytes.
fn newer(bytes: &mut Bytes, length: usize, pixels: &mut Vec<Rgbe>) -> Option<()> {
    let head = bytes.take(4)?;
    if usize::from(head[2]) << 8 | usize::from(head[3]) != length {
        return None;
    }
    let start = pixels.len();
    pixels.resize(start + length, [0; 4]);
    for component in 0..4 {
        let mut at = start;
        while at < pixels.len() {
            let code = bytes.byte()?;
            let count = usize::from(if code > 128 { code & 127 } else { code });
            let target = pixels.get_mut(at..at + count)?;
            if code > 128 {
                let value = bytes.byte()?;
                target.iter_mut().for_each(|pixel| pixel[component] = value);
            } else {
                let values = bytes.take(count)?;
                target.iter_mut().zip(values).for_each(|(pixel, v)| pixel[component] = *v);
            }
            at += count;
        }
    }
    Some(())
}

/// Pixels as they are; 1, 1, 1, n repeats the one before n times, and one such
/// after another counts 256 times as much.
fn older(bytes: &mut Bytes, end: usize, pixels: &mut Vec<Rgbe>) -> Option<()> {
    let start = pixels.len();
    let mut shift = 0;
    while pixels.len() < end {
        let pixel: Rgbe = bytes.take(4)?.try_into().ok()?;
        if pixel[..3] == [1, 1, 1] {
            let count = usize::from(pixel[3]).checked_shl(shift)?;
            let last = *pixels[start..].last()?;
            if count > end - pixels.len() {
                return None;
            }
            pixels.resize(pixels.len() + count, last);
            shift += 8;
        } else {
            pixels.push(pixel);
            shift = 0;
        }
    }
    Some(())
}
