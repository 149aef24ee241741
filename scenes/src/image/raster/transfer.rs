//! Curves and primaries that a file names: `gAMA`, `cHRM` and `cICP` of PNG.

use super::super::colour::{self, Chromaticities, REC_709};
use glam::DVec3;

/// Luminance of graphics white, cd/m². Source: ITU-R BT.2408-7, table 1.
const WHITE_NITS: f64 = 203.0;
/// A gamma this close to 1/2.2 means sRGB: writers of sRGB have no other number.
const GAMMA_OF_SRGB: std::ops::RangeInclusive<f64> = 0.450..=0.459;

/// From code values to linear light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Curve {
    Srgb,
    /// Light is the code value to this power.
    Power(f64),
    /// Inverse of the camera curve of BT.709 (BT.601 and BT.2020 have the same).
    Rec709,
    /// SMPTE ST 2084.
    Pq,
    /// ITU-R BT.2100 HLG on a display of 1000 cd/m².
    Hlg,
}

/// A curve and primaries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Described {
    pub(super) curve: Curve,
    pub(super) primaries: Chromaticities,
}

impl Described {
    /// What `gAMA` and `cHRM` say.
    pub(super) fn of_gamma(gamma: Option<f64>, primaries: Option<Chromaticities>) -> Self {
        let curve = match gamma {
            Some(gamma) if gamma > 0.0 && !GAMMA_OF_SRGB.contains(&gamma) => {
                Curve::Power(1.0 / gamma)
            }
            _ => Curve::Srgb,
        };
        Self { curve, primaries: primaries.unwrap_or(REC_709) }
    }

    /// What the code points of ITU-T H.273 say, tables 2 and 3.
    ///
    /// # Errors
    /// The code point that is not known.
    pub(super) fn of_code_points(primaries: u8, transfer: u8) -> Result<Self, String> {
        const D65: [f64; 2] = [0.3127, 0.3290];
        let xy = |red: [f64; 2], green, blue, white| Chromaticities { red, green, blue, white };
        let primaries = match primaries {
            1 => REC_709,
            4 => xy([0.67, 0.33], [0.21, 0.71], [0.14, 0.08], [0.310, 0.316]),
            5 => xy([0.64, 0.33], [0.29, 0.60], [0.15, 0.06], D65),
            6 | 7 => xy([0.630, 0.340], [0.310, 0.595], [0.155, 0.070], D65),
            8 => xy([0.681, 0.319], [0.243, 0.692], [0.145, 0.049], [0.310, 0.316]),
            9 => xy([0.708, 0.292], [0.170, 0.797], [0.131, 0.046], D65),
            10 => xy([1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0 / 3.0, 1.0 / 3.0]),
            11 => xy([0.680, 0.320], [0.265, 0.690], [0.150, 0.060], [0.314, 0.351]),
            12 => xy([0.680, 0.320], [0.265, 0.690], [0.150, 0.060], D65),
            22 => xy([0.630, 0.340], [0.295, 0.605], [0.155, 0.077], D65),
            other => return Err(format!("cICP names primaries {other}, which are not known")),
        };
        let curve = match transfer {
            1 | 6 | 14 | 15 => Curve::Rec709,
            4 => Curve::Power(2.2),
            5 => Curve::Power(2.8),
            8 => Curve::Power(1.0),
            13 => Curve::Srgb,
            16 => Curve::Pq,
            18 => Curve::Hlg,
            other => return Err(format!("cICP names the curve {other}, which is not known")),
        };
        Ok(Self { curve, primaries })
    }

    /// Code values of sRGB, `None` if they are that already.
    ///
    /// # Errors
    /// If the primaries do not span the colours.
    pub(super) fn to_srgb(self, colours: &[f64]) -> Result<Option<Vec<f64>>, String> {
        let same_primaries = self.primaries.is_rec_709();
        if self.curve == Curve::Srgb && same_primaries {
            return Ok(None);
        }
        let mut linear: Vec<f64> = colours.iter().map(|code| self.curve.linear(*code)).collect();
        if self.curve == Curve::Hlg {
            show_on_display(&mut linear, &self.primaries);
        }
        if !same_primaries {
            let matrix = self.primaries.rec_709_from_rgb();
            let matrix = matrix.ok_or("its primaries do not span the colours")?;
            colour::transform(&mut linear, &matrix);
        }
        linear.iter_mut().for_each(|value| *value = colour::srgb_from_linear(*value));
        Ok(Some(linear))
    }
}

impl Curve {
    /// Linear light of a code value in 0..1; graphics white is 1.
    fn linear(self, code: f64) -> f64 {
        match self {
            Self::Srgb => colour::linear_from_srgb(code),
            Self::Power(power) => code.max(0.0).powf(power),
            Self::Rec709 if code < 0.081 => code / 4.5,
            Self::Rec709 => ((code + 0.099) / 1.099).powf(1.0 / 0.45),
            Self::Pq => pq_nits(code) / WHITE_NITS,
            Self::Hlg => hlg_scene(code),
        }
    }
}

/// Luminance of a PQ code value, cd/m². Source: SMPTE ST 2084:2014, eq. 4.1.
fn pq_nits(code: f64) -> f64 {
    let (m1, m2) = (2610.0 / 16384.0, 2523.0 / 4096.0 * 128.0);
    let (c1, c2, c3) = (3424.0 / 4096.0, 2413.0 / 4096.0 * 32.0, 2392.0 / 4096.0 * 32.0);
    let root = code.clamp(0.0, 1.0).powf(1.0 / m2);
    10_000.0 * ((root - c1).max(0.0) / (c2 - c3 * root)).powf(1.0 / m1)
}

/// Scene light of an HLG code value, 0..1. Source: ITU-R BT.2100-2, table 5.
fn hlg_scene(code: f64) -> f64 {
    const A: f64 = 0.178_832_77;
    const B: f64 = 0.284_668_92;
    const C: f64 = 0.559_910_73;
    let code = code.clamp(0.0, 1.0);
    if code <= 0.5 { code * code / 3.0 } else { (((code - C) / A).exp() + B) / 12.0 }
}

/// Scene light to that of a display of 1000 cd/m²: gamma 1.2 on the luminance.
/// Source: ITU-R BT.2100-2, table 5.
fn show_on_display(linear: &mut [f64], primaries: &Chromaticities) {
    let weights = primaries.luminance_weights().unwrap_or(DVec3::splat(1.0 / 3.0));
    for pixel in linear.chunks_exact_mut(3) {
        let luminance = weights.dot(DVec3::from_slice(pixel));
        let gain = luminance.max(0.0).powf(0.2) * 1000.0 / WHITE_NITS;
        pixel.iter_mut().for_each(|value| *value *= gain);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    /// Both curves of BT.2100 put graphics white where BT.2408 does: 58 % of PQ
    /// and 75 % of HLG.
    #[test]
    fn graphics_white_is_one() {
        assert!((Curve::Pq.linear(0.58) - 1.0).abs() < 0.01, "{}", Curve::Pq.linear(0.58));
        let mut white = [hlg_scene(0.75); 3];
        show_on_display(&mut white, &REC_709);
        assert!((white[0] - 1.0).abs() < 0.01, "{}", white[0]);
        assert!((pq_nits(1.0) - 10_000.0).abs() < 1e-6);
    }

    #[test]
    fn a_gamma_of_one_is_light_itself() {
        let linear = Described::of_gamma(Some(1.0), None);
        let codes = linear.to_srgb(&[0.5, 0.0, 1.0]).unwrap_or_default().unwrap_or_default();
        assert!((codes[0] - 0.735_357).abs() < 1e-6, "{codes:?}");
        assert_eq!(Described::of_gamma(Some(0.45455), None).to_srgb(&[0.5; 3]), Ok(None));
        assert_eq!(Described::of_gamma(None, None).to_srgb(&[0.5; 3]), Ok(None));
    }

    #[test]
    fn rec_709_bends_at_its_foot() {
        let curve = Curve::Rec709;
        assert!((curve.linear(0.081) - 0.018).abs() < 1e-4 && curve.linear(1.0) == 1.0);
        assert!((curve.linear(0.0405) - 0.009).abs() < 1e-12);
    }

    #[test]
    fn unknown_code_points_are_named() {
        let error = Described::of_code_points(1, 77).unwrap_err();
        assert!(error.contains("curve 77"), "{error}");
    }
}
