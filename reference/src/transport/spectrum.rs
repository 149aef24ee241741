//! The wavelengths that stand for light: one where nothing disperses, one per colour
//! channel, or many across the visible spectrum.

use crate::request::{Restriction, Spectrum};
use crate::transport::media_optics::MediaOptics;
use crate::world::World;
use glam::{DMat3, DVec3};
use scenes::Scene;
use scenes::medium::{DispersionError, RGB_WAVELENGTH_UM};

/// Light of one wavelength.
#[derive(Clone, Debug)]
pub(crate) struct Wavelength {
    pub(crate) optics: MediaOptics,
    /// Linear R, G, B that reach the image, from those that it brings.
    pub(crate) share: DMat3,
}

/// What wavelengths bring, added up.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Total {
    pub(crate) radiance: DVec3,
    /// Bound on what was dropped, of radiance 1, per channel.
    truncated: DVec3,
}

impl Wavelength {
    /// The wavelengths of a scene. Their shares add up to the identity, so that a scene
    /// without dispersion would look the same with any of them.
    pub(crate) fn all(
        scene: &Scene,
        world: &World,
        spectrum: Spectrum,
        restriction: &Restriction,
    ) -> Vec<Self> {
        let one = |wavelength_um, share| Self {
            optics: MediaOptics::new(scene, world, wavelength_um, restriction.fresnel),
            share,
        };
        lines(scene, spectrum).into_iter().map(|(line, share)| one(line, share)).collect()
    }

    /// Adds what this one brings.
    pub(crate) fn add(&self, brings: DVec3, truncated: f64, total: &mut Total) {
        total.radiance += self.share * brings;
        let rows = self.share.transpose().to_cols_array_2d().map(DVec3::from_array);
        let reach = DVec3::from_array(rows.map(|row| row.abs().element_sum()));
        total.truncated += reach * truncated;
    }
}

/// That every medium has an index at every wavelength that would be traced.
pub(crate) fn check(scene: &Scene, spectrum: Spectrum) -> Result<(), DispersionError> {
    let lines = lines(scene, spectrum);
    scene.media.iter().try_for_each(|medium| {
        medium.check_at(RGB_WAVELENGTH_UM)?;
        medium.check_at(lines.iter().map(|(line, _)| *line))
    })
}

/// Wavelengths to trace, micrometres, and their shares.
fn lines(scene: &Scene, spectrum: Spectrum) -> Vec<(f64, DMat3)> {
    if !scene.media.iter().any(scenes::Medium::is_dispersive) {
        return vec![(D_LINE_UM, DMat3::IDENTITY)];
    }
    match spectrum {
        Spectrum::Channels => {
            let share = |axis| DMat3::from_diagonal(DVec3::from_array(axis));
            let axes = DMat3::IDENTITY.to_cols_array_2d();
            RGB_WAVELENGTH_UM.into_iter().zip(axes.map(share)).collect()
        }
        Spectrum::Wavelengths(count) => shares(count),
    }
}

impl Total {
    pub(crate) fn truncated(&self) -> f64 {
        self.truncated.max_element()
    }
}

/// The line at which indices are stated.
pub(crate) const D_LINE_UM: f64 = RGB_WAVELENGTH_UM[1];
/// Ends of the spectrum, micrometres: beyond them the eye's response is below a
/// thousandth of its peak.
const VISIBLE_UM: [f64; 2] = [0.390, 0.730];

/// Wavelengths at the middles of equal steps, and their shares.
///
/// An image's R, G, B are integrals of light with the responses w of the colour
/// space. Light that is given as R, G, B becomes the spectrum 1/3 + A w per
/// channel: of all spectra that give these numbers back, the one nearest to
/// grey, and constant for white. w and A are normalised on the wavelengths that
/// are traced, so there is no error of quadrature without dispersion.
fn shares(count: u32) -> Vec<(f64, DMat3)> {
    let [low, high] = VISIBLE_UM;
    let step = (high - low) / f64::from(count);
    let lines: Vec<f64> = (0..count).map(|i| low + (f64::from(i) + 0.5) * step).collect();
    let responses: Vec<DVec3> = lines.iter().map(|line| response(*line)).collect();
    let sum: DVec3 = responses.iter().sum();
    let responses: Vec<DVec3> = responses.into_iter().map(|w| w / sum).collect();
    // Column k holds the k-th channel times the responses: symmetric.
    let gram = responses.iter().fold(DMat3::ZERO, |gram, w| gram + outer(*w, *w));
    let third = DMat3::from_cols_array(&[1.0 / 3.0; 9]);
    let mix = (DMat3::IDENTITY - third) * gram.inverse();
    let share = |w: &DVec3| outer(*w, DVec3::splat(1.0 / 3.0) + mix * *w);
    lines.into_iter().zip(responses.iter().map(share)).collect()
}

/// a bᵀ.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// Response of linear sRGB to light of one wavelength, up to a factor per
/// channel.
///
/// Source: the colour-matching functions of CIE 1931 as fitted by Wyman, Sloan
/// & Shirley, "Simple analytic approximations to the CIE XYZ color matching
/// functions", JCGT 2(2), 2013; matrix: IEC 61966-2-1.
fn response(wavelength_um: f64) -> DVec3 {
    let lobe = |peak: f64, below: f64, above: f64| {
        let away = 1e3 * wavelength_um - peak;
        let width = if away < 0.0 { below } else { above };
        (-0.5 * (away / width).powi(2)).exp()
    };
    let x = 1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7)
        - 0.065 * lobe(501.1, 20.4, 26.2);
    let y = 0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1);
    let z = 1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8);
    DVec3::new(
        3.240_625_5 * x - 1.537_208 * y - 0.498_628_6 * z,
        -0.968_930_7 * x + 1.875_756_1 * y + 0.041_517_5 * z,
        0.055_710_1 * x - 0.204_021_1 * y + 1.056_995_9 * z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever R, G, B the light has, it comes back; white light is constant.
    #[test]
    fn shares_give_every_colour_back() {
        for count in [8, 9, 31, 256] {
            let all = shares(count);
            let sum = all.iter().fold(DMat3::ZERO, |sum, (_, share)| sum + *share);
            assert!(sum.abs_diff_eq(DMat3::IDENTITY, 1e-13), "{count}: {sum}");
            let responses: DVec3 = all.iter().map(|(line, _)| response(*line)).sum();
            for (line, share) in &all {
                let white = *share * DVec3::ONE;
                assert!(white.abs_diff_eq(response(*line) / responses, 1e-13), "{line}: {white}");
            }
        }
    }

    /// sRGB sees red, green and blue where they are.
    #[test]
    fn responses_peak_at_their_colours() {
        for (channel, lowest, highest) in [(0, 0.58, 0.62), (1, 0.52, 0.56), (2, 0.43, 0.46)] {
            let at = |i: &i32| response(0.39 + 0.001 * f64::from(*i))[channel];
            let peak = (0..340).max_by(|a, b| at(a).total_cmp(&at(b)));
            let peak = 0.39 + 0.001 * f64::from(peak.unwrap_or(0));
            assert!((lowest..highest).contains(&peak), "channel {channel}: {peak}");
        }
    }
}
