//! Primaries and whites: from what a file says of its colours to Rec. 709.

use glam::{DMat3, DVec3};

/// CIE 1931 xy of red, green, blue and white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chromaticities {
    pub(super) red: [f64; 2],
    pub(super) green: [f64; 2],
    pub(super) blue: [f64; 2],
    pub(super) white: [f64; 2],
}

/// ITU-R BT.709-6, table 1 (sRGB has the same).
pub(super) const REC_709: Chromaticities = Chromaticities {
    red: [0.64, 0.33],
    green: [0.30, 0.60],
    blue: [0.15, 0.06],
    white: [0.3127, 0.3290],
};
/// Files round what they say; below this two chromaticities are the same.
const SAME: f64 = 1e-3;
/// Cone responses of XYZ. Source: Lam, Metamerism and colour constancy, 1985
/// ("Bradford"), as in ICC.1:2010 annex E.
const BRADFORD: [[f64; 3]; 3] =
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

impl Chromaticities {
    /// `xy` of red, green, blue, white, in this order.
    pub(super) fn from_array([rx, ry, gx, gy, bx, by, wx, wy]: [f64; 8]) -> Self {
        Self { red: [rx, ry], green: [gx, gy], blue: [bx, by], white: [wx, wy] }
    }

    fn corners(&self) -> [[f64; 2]; 4] {
        [self.red, self.green, self.blue, self.white]
    }

    /// True for Rec. 709 up to what files round.
    pub(super) fn is_rec_709(&self) -> bool {
        let pairs = self.corners().into_iter().zip(REC_709.corners());
        pairs.flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]]).all(|d| d.abs() < SAME)
    }

    /// True where the three numbers of a pixel are X, Y and Z themselves.
    fn is_xyz(&self) -> bool {
        [self.red, self.green, self.blue] == [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]
    }

    /// CIE XYZ of linear R, G, B, white having Y = 1; `None` where the four do
    /// not span the colours.
    ///
    /// Source: SMPTE RP 177-1993, §3.3.
    pub(super) fn xyz_from_rgb(&self) -> Option<DMat3> {
        let z = |[x, y]: [f64; 2]| DVec3::new(x, y, 1.0 - x - y);
        let axes = DMat3::from_cols(z(self.red), z(self.green), z(self.blue));
        let white = z(self.white) / self.white[1];
        let scale = axes.inverse() * white;
        let found = axes * DMat3::from_diagonal(scale);
        let usable = found.is_finite() && found.determinant().abs() > 1e-9;
        usable.then_some(found)
    }

    /// Linear Rec. 709 of linear R, G, B: white goes to white, by Bradford's
    /// adaptation. X, Y, Z themselves name a colour and are not adapted.
    pub(super) fn rec_709_from_rgb(&self) -> Option<DMat3> {
        let rgb_from_xyz = rec_709_from_xyz();
        if self.is_xyz() {
            return Some(rgb_from_xyz);
        }
        let adapted = adaptation(self.white, REC_709.white);
        Some(rgb_from_xyz * adapted * self.xyz_from_rgb()?)
    }

    /// Shares of R, G and B in the luminance; their sum is 1.
    pub(super) fn luminance_weights(&self) -> Option<DVec3> {
        let row = self.xyz_from_rgb()?.row(1);
        Some(row / row.element_sum())
    }
}

/// Linear Rec. 709 of CIE XYZ, not adapted.
pub(super) fn rec_709_from_xyz() -> DMat3 {
    REC_709.xyz_from_rgb().map_or(DMat3::IDENTITY, |matrix| matrix.inverse())
}

/// XYZ under one white from XYZ under another.
fn adaptation(from: [f64; 2], to: [f64; 2]) -> DMat3 {
    let cones = DMat3::from_cols_array_2d(&BRADFORD).transpose();
    let response = |[x, y]: [f64; 2]| cones * DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    cones.inverse() * DMat3::from_diagonal(response(to) / response(from)) * cones
}

/// Applies a matrix to pixels of three values, in place.
pub(super) fn transform(pixels: &mut [f64], matrix: &DMat3) {
    for pixel in pixels.chunks_exact_mut(3) {
        pixel.copy_from_slice(&(*matrix * DVec3::from_slice(pixel)).to_array());
    }
}

/// Code value of a linear value by sRGB's curve; odd about 0, so that what lies
/// outside sRGB stays apart.
///
/// Source: IEC 61966-2-1:1999 and, below 0, its amendment 1 (scRGB).
pub(super) fn srgb_from_linear(linear: f64) -> f64 {
    let l = linear.abs();
    let code = if l <= 0.003_130_8 { 12.92 * l } else { 1.055 * l.powf(1.0 / 2.4) - 0.055 };
    code.copysign(linear)
}

/// Linear value of an sRGB code value; inverse of [`srgb_from_linear`].
pub(super) fn linear_from_srgb(code: f64) -> f64 {
    let c = code.abs();
    let linear = if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
    linear.copysign(code)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    /// The matrix of IEC 61966-2-1, to the four decimals that it prints.
    #[test]
    fn the_matrix_of_rec_709_is_the_standards() {
        let m = REC_709.xyz_from_rgb().unwrap();
        let standard =
            [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        for (row, expected) in standard.iter().enumerate() {
            for (column, expected) in expected.iter().enumerate() {
                assert!((m.row(row)[column] - expected).abs() < 5.1e-5, "{row} {column}");
            }
        }
    }

    /// Rec. 2020 to Rec. 709: the matrix of ITU-R BT.2087-0, annex 2 inverted.
    #[test]
    fn rec_2020_becomes_rec_709() {
        let wide = [0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290];
        let m = Chromaticities::from_array(wide).rec_709_from_rgb().unwrap();
        let red = m * DVec3::X;
        assert!((red - DVec3::new(1.6605, -0.1246, -0.0182)).length() < 2e-4, "{red}");
        assert!((m * DVec3::ONE - DVec3::ONE).length() < 1e-12);
        assert!(!Chromaticities::from_array(wide).is_rec_709() && REC_709.is_rec_709());
    }

    /// Bradford's matrix from D50 to D65, as Lindbloom and ICC.1 print it.
    #[test]
    fn whites_are_adapted() {
        let m = adaptation([0.34567, 0.35850], [0.31271, 0.32902]);
        let expected = DVec3::new(0.9555766, -0.0230393, 0.0631636);
        assert!((m.row(0) - expected).length() < 3e-4, "{}", m.row(0));
    }

    #[test]
    fn curves_are_each_others_inverse_on_both_sides_of_black() {
        for step in -20..=40 {
            let linear = f64::from(step) / 20.0;
            assert!((linear_from_srgb(srgb_from_linear(linear)) - linear).abs() < 1e-6);
        }
    }

    #[test]
    fn points_on_a_line_span_nothing() {
        let flat = Chromaticities::from_array([0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.25, 0.25]);
        assert!(flat.rec_709_from_rgb().is_none());
    }
}
