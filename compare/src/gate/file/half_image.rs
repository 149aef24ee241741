//! An image of half floats, as a baseline keeps it.

use flate2::{Compression, read::ZlibDecoder, write::ZlibEncoder};
use half::f16;
use std::io::{Read, Write};

/// Largest value after scaling; half floats end at 65504.
const LARGEST: f64 = 32_768.0;

/// Interleaved RGB as half floats times a power of two, so that no finite
/// radiance is out of range.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HalfImage {
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// The values are half floats times 2 to this power.
    pub stops: i32,
    codes: Vec<u16>,
}

impl HalfImage {
    /// Rounds an image; `None` if a value is not finite.
    #[must_use]
    pub fn of(values: &[f64], size_px: [u32; 2]) -> Option<Self> {
        let largest = values.iter().fold(0.0f64, |most, v| most.max(v.abs()));
        if !values.iter().all(|value| value.is_finite()) {
            return None;
        }
        // 0 for everything that fits as it is.
        let stops = (largest / LARGEST).log2().ceil().max(0.0) as i32;
        let code = |value: &f64| f16::from_f64(value * f64::from(-stops).exp2()).to_bits();
        Some(Self { size_px, stops, codes: values.iter().map(code).collect() })
    }

    /// The values as they were rounded.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        let scale = f64::from(self.stops).exp2();
        self.codes.iter().map(|code| f16::from_bits(*code).to_f64() * scale).collect()
    }

    /// Bytes of the values: differences to the left neighbour per channel, low
    /// bytes before high bytes, zlib.
    #[must_use]
    pub fn pack(&self) -> Vec<u8> {
        let count = self.codes.len();
        let mut bytes = vec![0u8; 2 * count];
        let (low, high) = bytes.split_at_mut(count);
        for (i, code) in self.codes.iter().enumerate() {
            let left = if i >= 3 { self.codes[i - 3] } else { 0 };
            // Planes: all of the first channel, then the second, then the third.
            let place = i % 3 * (count / 3) + i / 3;
            [low[place], high[place]] = code.wrapping_sub(left).to_le_bytes();
        }
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        // Writing into memory does not fail.
        encoder.write_all(&bytes).and_then(|()| encoder.finish()).unwrap_or_default()
    }

    /// Undoes [`HalfImage::pack`]; `None` if the bytes are not those of such an
    /// image.
    #[must_use]
    pub fn unpack(bytes: &[u8], size_px: [u32; 2], stops: i32) -> Option<Self> {
        let pixels = size_px[0].checked_mul(size_px[1])?;
        let count = 3 * usize::try_from(pixels).ok()?;
        let mut found = Vec::new();
        // One byte more than there should be shows that there are too many.
        ZlibDecoder::new(bytes).take(2 * count as u64 + 1).read_to_end(&mut found).ok()?;
        if found.len() != 2 * count {
            return None;
        }
        let (low, high) = found.split_at(count);
        let mut codes = vec![0u16; count];
        for i in 0..count {
            let place = i % 3 * (count / 3) + i / 3;
            let left = if i >= 3 { codes[i - 3] } else { 0 };
            codes[i] = u16::from_le_bytes([low[place], high[place]]).wrapping_add(left);
        }
        Some(Self { size_px, stops, codes })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;

    #[test]
    fn an_image_survives_within_half_a_step_and_twice_rounded_is_once() {
        let values: Vec<f64> = (0..5 * 4 * 3).map(|i| (f64::from(i) * 0.7).sin() * 3e5).collect();
        let image = HalfImage::of(&values, [5, 4]).unwrap();
        assert!(image.stops > 0, "3e5 is no half float");
        let back = HalfImage::unpack(&image.pack(), image.size_px, image.stops).unwrap();
        assert_eq!(back, image);
        for (value, kept) in values.iter().zip(image.values()) {
            assert!((value - kept).abs() <= value.abs() * 2f64.powi(-11) + 1e-3, "{value} {kept}");
        }
        assert_eq!(HalfImage::of(&image.values(), [5, 4]).unwrap(), image);
    }

    #[test]
    fn what_is_not_finite_is_not_kept_and_what_is_cut_off_is_not_read() {
        assert!(HalfImage::of(&[1.0, f64::NAN, 0.0], [1, 1]).is_none());
        assert!(HalfImage::of(&[1.0, f64::INFINITY, 0.0], [1, 1]).is_none());
        let packed = HalfImage::of(&[1.0, 2.0, 3.0], [1, 1]).unwrap().pack();
        assert!(HalfImage::unpack(&packed[..packed.len() - 6], [1, 1], 0).is_none());
        assert!(HalfImage::unpack(&packed, [2, 1], 0).is_none());
        assert!(HalfImage::unpack(&packed, [u32::MAX, 2], 0).is_none());
    }
}
