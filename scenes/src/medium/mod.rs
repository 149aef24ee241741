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
