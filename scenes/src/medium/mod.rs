//! Media: an index, how it varies with wavelength, and what it absorbs.

pub mod eta;
pub mod materials;

use crate::Eta;
use glam::DVec3;

/// Index into [`crate::Scene::media`]; 0 is the medium of the surroundings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MediumId(pub u16);

impl MediumId {
    /// What fills the space outside every object.
    pub const SURROUNDINGS: Self = Self(0);
}

/// A homogeneous transparent medium.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// Name in the scene file, `"vacuum"` for the default surroundings.
    pub name: String,
    /// Index at the sodium/helium d line (587.5618 nm).
    pub eta: Eta,
    /// How the index varies with wavelength.
    pub dispersion: Dispersion,
    /// Absorption coefficient per metre for R, G, B: radiance falls by
    /// exp(-absorption · length).
    pub absorption_per_m: DVec3,
}

/// Variation of the index with wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dispersion {
    /// The same index for every wavelength.
    None,
    /// n(λ) = a + b / λ², λ in micrometres.
    Cauchy {
        /// Index in the limit of long waves.
        a: f64,
        /// In µm².
        b_um2: f64,
    },
    /// n²(λ) = 1 + Σ bᵢ λ² / (λ² - cᵢ), λ in micrometres.
    Sellmeier {
        /// Dimensionless strengths.
        b: [f64; 3],
        /// Squared resonance wavelengths in µm².
        c_um2: [f64; 3],
    },
    /// glTF `KHR_materials_dispersion`: 20 / Abbe number, as a Cauchy law
    /// through the medium's d-line index.
    Gltf {
        /// 20 / V.
        dispersion: f64,
    },
}

/// Indices that light of some colour may meet in a dispersive medium. Below 1
/// (anomalous dispersion) light is totally reflected from outside; at 0 and below
/// a law has left the range of wavelengths for which it was fitted.
pub const ETA_OF_A_COLOUR: std::ops::RangeInclusive<f64> = 0.1..=1e6;

/// A law of dispersion that gives no index at a wavelength that is traced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "medium \"{medium}\": its law of dispersion gives the index {eta:.4} at {nm:.1} nm, and an index \
     lies from {least} to {most:e}\n{advice}",
    least = ETA_OF_A_COLOUR.start(),
    most = ETA_OF_A_COLOUR.end()
)]
pub struct DispersionError {
    /// Name of the medium.
    pub medium: String,
    /// Vacuum wavelength, nanometres.
    pub nm: f64,
    /// What the law gives there.
    pub eta: f64,
    /// What to write instead.
    pub advice: &'static str,
}

/// Wavelengths that stand for R, G, B: the C, d and F lines, in micrometres.
pub const RGB_WAVELENGTH_UM: [f64; 3] = [0.656_272_5, 0.587_561_8, 0.486_132_7];

impl Medium {
    /// Empty space.
    #[must_use]
    pub fn vacuum() -> Self {
        Self::plain("vacuum", Eta::VACUUM)
    }

    /// A medium without dispersion or absorption.
    #[must_use]
    pub fn plain(name: &str, eta: Eta) -> Self {
        Self {
            name: name.to_owned(),
            eta,
            dispersion: Dispersion::None,
            absorption_per_m: DVec3::ZERO,
        }
    }

    /// Absolute index at a wavelength in micrometres.
    #[must_use]
    pub fn eta_at(&self, wavelength_um: f64) -> f64 {
        let l2 = wavelength_um * wavelength_um;
        match self.dispersion {
            Dispersion::None => self.eta.get(),
            Dispersion::Cauchy { a, b_um2 } => a + b_um2 / l2,
            Dispersion::Sellmeier { b, c_um2 } => {
                let n2 = 1.0 + (0..3).map(|i| b[i] * l2 / (l2 - c_um2[i])).sum::<f64>();
                n2.max(0.0).sqrt()
            }
            Dispersion::Gltf { dispersion } => {
                let [c, d, f] = RGB_WAVELENGTH_UM.map(|l| 1.0 / (l * l));
                // V = (n_d - 1) / (n_F - n_C) and dispersion = 20 / V fix b.
                let b_um2 = (self.eta.get() - 1.0) * dispersion / 20.0 / (f - c);
                self.eta.get() + b_um2 * (1.0 / l2 - d)
            }
        }
    }

    /// That the law gives an index at each of these vacuum wavelengths
    /// (micrometres).
    ///
    /// # Errors
    /// At the first where it does not.
    pub fn check_at(
        &self,
        wavelengths_um: impl IntoIterator<Item = f64>,
    ) -> Result<(), DispersionError> {
        let mut all = wavelengths_um.into_iter().map(|um| (um, self.eta_at(um)));
        // NaN lies in no range.
        let Some((um, eta)) = all.find(|(_, eta)| !ETA_OF_A_COLOUR.contains(eta)) else {
            return Ok(());
        };
        let advice = match self.dispersion {
            Dispersion::Gltf { .. } => {
                "dispersion is 20 / Abbe number: write 0.25 to 1 for glass, such as 0.31 for crown"
            }
            _ => {
                "write coefficients for micrometres, such as cauchy = { a = 1.5046, b_um2 = 0.0042 }"
            }
        };
        Err(DispersionError { medium: self.name.clone(), nm: 1e3 * um, eta, advice })
    }

    /// What people should know of its index.
    #[must_use]
    pub fn doubt(&self) -> Option<String> {
        self.eta.is_unusual().then(|| {
            let (name, eta, most) = (&self.name, self.eta.get(), Eta::LARGEST_KNOWN);
            format!(
                "medium \"{name}\" has index {eta}: no transparent medium above {most} is known"
            )
        })
    }

    /// True when the three colour channels bend differently.
    #[must_use]
    pub fn is_dispersive(&self) -> bool {
        let [r, g, b] = RGB_WAVELENGTH_UM.map(|l| self.eta_at(l));
        r != g || g != b
    }

    /// True when light grows weaker along a path inside.
    #[must_use]
    pub fn absorbs(&self) -> bool {
        self.absorption_per_m != DVec3::ZERO
    }
}
