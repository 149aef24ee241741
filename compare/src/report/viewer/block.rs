//! HDR pixels inside an HTML page: half floats, compressed, as base64.
//!
//! Each channel is a plane; each row of a plane holds differences to the left
//! neighbour (of the bits, modulo 2^16); all low bytes come first, then all
//! high bytes; then zlib. A browser undoes it with `DecompressionStream`.

use flate2::{Compression, write::ZlibEncoder};
use half::f16;
use std::io::Write;

/// Encodes interleaved values as base64 text. Values beyond the half-float
/// range become its largest finite value, so that a display can show them.
#[must_use]
pub fn encode(values: &[f64], channels: usize, width: usize) -> String {
    let count = values.len();
    let mut bytes = vec![0u8; 2 * count];
    let (low, high) = bytes.split_at_mut(count);
    let pixels = count / channels;
    for plane in 0..channels {
        let mut left = 0u16;
        for pixel in 0..pixels {
            if pixel % width == 0 {
                left = 0;
            }
            let value = values[pixel * channels + plane];
            let limited = value.clamp(-65504.0, 65504.0);
            let bits = f16::from_f64(limited).to_bits();
            let [l, h] = bits.wrapping_sub(left).to_le_bytes();
            (low[plane * pixels + pixel], high[plane * pixels + pixel]) = (l, h);
            left = bits;
        }
    }
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(6));
    // Writing into memory does not fail.
    let compressed = encoder.write_all(&bytes).and_then(|()| encoder.finish());
    base64(&compressed.unwrap_or_default())
}

/// Base64 with padding (RFC 4648 §4).
#[must_use]
pub fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let at = |i: usize| u32::from(group.get(i).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for place in 0..4 {
            if place <= group.len() {
                let six = bits >> (18 - 6 * place) & 63;
                text.push(char::from(ALPHABET[six as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_equals_the_examples_of_its_standard() {
        let cases =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in cases {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn smooth_pictures_become_small() {
        let width = 64;
        let smooth: Vec<f64> =
            (0..width * width * 3).map(|i| 0.5 + (i / 3 % width) as f64 / 64.0).collect();
        let size = encode(&smooth, 3, width).len();
        assert!(size * 8 < smooth.len() * 2, "{size} bytes for {} raw", smooth.len() * 2);
    }
}
