//! Colours for numbers: perceptually even maps for error images, and the tone
//! map that shows radiance.

use std::sync::LazyLock;

/// An 8-bit sRGB colour.
pub type Colour = [u8; 3];

/// Colour of pixels that have no value, such as an exit angle where light
/// does not leave.
pub const NOTHING: Colour = [128, 128, 128];
/// Colour of pixels whose value is NaN or infinite although it should exist.
pub const BROKEN: Colour = [255, 0, 255];

/// Dark violet to light yellow: OKLab lightness rises linearly, hue turns from
/// violet over teal to yellow, so that the order survives grey print and
/// colour blindness. `share` is clamped to 0..=1.
///
/// Source: Ottosson, *A perceptual color space for image processing*, 2020.
#[must_use]
pub fn ramp(share: f64) -> Colour {
    static TABLE: LazyLock<[Colour; 256]> =
        LazyLock::new(|| std::array::from_fn(|i| ramp_exact(i as f64 / 255.0)));
    TABLE[(share.clamp(0.0, 1.0) * 255.0).round() as usize]
}

fn ramp_exact(share: f64) -> Colour {
    let lightness = 0.22 + 0.72 * share;
    let hue = (305.0 - 200.0 * share).to_radians();
    let mut chroma = 0.16;
    loop {
        let rgb = oklab_to_linear_srgb([lightness, chroma * hue.cos(), chroma * hue.sin()]);
        if chroma <= 0.0 || rgb.iter().all(|c| (0.0..=1.0).contains(c)) {
            return rgb.map(|c| byte(c.clamp(0.0, 1.0)));
        }
        chroma -= 0.002;
    }
}

fn oklab_to_linear_srgb([l, a, b]: [f64; 3]) -> [f64; 3] {
    let long = (l + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let medium = (l - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let short = (l - 0.089_484_177_5 * a - 1.291_485_548 * b).powi(3);
    [
        4.076_741_662_1 * long - 3.307_711_591_3 * medium + 0.230_969_929_2 * short,
        -1.268_438_004_6 * long + 2.609_757_401_1 * medium - 0.341_319_396_5 * short,
        -0.004_196_086_3 * long - 0.703_418_614_7 * medium + 1.707_614_701 * short,
    ]
}

/// Colour of a FLIP value 0..=1, the map that FLIP images have elsewhere.
#[must_use]
pub fn flip(value: f64) -> Colour {
    let index = (value.clamp(0.0, 1.0) * 255.0 + 0.5) as usize;
    flip_rs::MAGMA[index.min(255)].map(|channel| (channel * 255.0).round() as u8)
}

/// Smallest and largest angle of [`angle_share`], degrees.
pub const ANGLE_RANGE_DEG: (f64, f64) = (0.1, 90.0);

/// Place of an angle in degrees on a logarithmic scale from 0.1° (0) to
/// 90° (1).
#[must_use]
pub fn angle_share(degrees: f64) -> f64 {
    let (low, high) = ANGLE_RANGE_DEG;
    ((degrees.max(1e-12) / low).ln() / (high / low).ln()).clamp(0.0, 1.0)
}

/// Display colour of a radiance: times 2^ev, filmic curve, sRGB.
///
/// Source of the curve: Narkowicz, *ACES filmic tone mapping curve*, 2015,
/// with FLIP's factor 0.6 in front.
#[must_use]
pub fn show(radiance: [f64; 3], ev: f64) -> Colour {
    if radiance.iter().any(|value| !value.is_finite()) {
        return BROKEN;
    }
    radiance.map(|value| {
        let x = (0.6 * value * ev.exp2()).max(0.0);
        byte(((2.51 * x * x + 0.03 * x) / (2.43 * x * x + 0.59 * x + 0.14)).clamp(0.0, 1.0))
    })
}

/// 8-bit sRGB code value of a linear 0..=1.
fn byte(linear: f64) -> u8 {
    (255.0 * crate::metric::display::srgb_encode(linear) + 0.5) as u8
}

/// The exposure (power of two) that a picture and all its approximations are
/// shown at: it brings the geometric mean of the lit luminances to 0.25.
#[must_use]
pub fn exposure(radiance: &[f64]) -> f64 {
    let logarithms: Vec<f64> = radiance
        .chunks_exact(3)
        .map(|p| 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2])
        .filter(|y| y.is_finite() && *y > 1e-6)
        .map(f64::log2)
        .collect();
    if logarithms.is_empty() {
        return 0.0;
    }
    let mean = crate::support::sum::mean(logarithms.into_iter());
    ((0.25f64.log2() - mean) * 4.0).round() / 4.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(colour: Colour) -> f64 {
        let [r, g, b] = colour.map(|c| {
            let encoded = f64::from(c) / 255.0;
            crate::metric::display::srgb_decode(encoded)
        });
        let cube = |r0: f64, g0: f64, b0: f64| (r0 * r + g0 * g + b0 * b).cbrt();
        0.210_454_255_3 * cube(0.412_221_470_8, 0.536_332_536_3, 0.051_445_992_9)
            + 0.793_617_785 * cube(0.211_903_498_2, 0.680_699_545_1, 0.107_396_956_6)
            - 0.004_072_046_8 * cube(0.088_302_461_9, 0.281_718_837_6, 0.629_978_700_5)
    }

    #[test]
    fn the_ramp_grows_evenly_lighter() {
        for step in 0..16 {
            let at = |i: i32| lightness(ramp(f64::from(i) / 16.0));
            let gain = at(step + 1) - at(step);
            assert!((gain - 0.72 / 16.0).abs() < 0.01, "step {step}: {gain}");
        }
        assert!(lightness(flip(1.0)) > lightness(flip(0.0)));
    }

    #[test]
    fn exposure_doubles_per_stop_and_nan_is_seen() {
        assert_eq!(show([0.1, 0.2, 0.3], 1.0), show([0.2, 0.4, 0.6], 0.0));
        assert_eq!(show([f64::NAN, 0.0, 0.0], 0.0), BROKEN);
        assert_eq!(exposure(&[1.0; 12]), -2.0);
        assert_eq!(exposure(&[0.0; 12]), 0.0);
    }

    #[test]
    fn angles_are_placed_logarithmically() {
        assert_eq!(angle_share(0.0), 0.0);
        assert_eq!(angle_share(0.1), 0.0);
        assert!((angle_share(3.0) - 0.5).abs() < 1e-12);
        assert_eq!(angle_share(180.0), 1.0);
    }
}
