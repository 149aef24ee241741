//! A refractive index, checked where it enters.

use serde::{Deserialize, Serialize};

/// Absolute refractive index of ONE medium (dimensionless, vacuum = 1).
///
/// Accepted: 1 to 1e6. Larger values than [`Eta::LARGEST_KNOWN`] are allowed
/// because limits are worth testing, and `is_unusual` says so.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Deserialize, Serialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Eta(f64);

/// Why a number is not a refractive index.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EtaError {
    /// Below vacuum.
    #[error(
        "refractive index {0} is below 1 (vacuum)\nindices are absolute: an air bubble in glass is \
         an object of medium \"vacuum\" with a higher priority"
    )]
    BelowVacuum(f64),
    /// Not a number, infinite, or beyond 1e6.
    #[error("refractive index {0} is not a finite number from 1 to 1e6; write for example 1.5")]
    OutOfRange(f64),
}

impl Eta {
    /// Vacuum, exactly 1.
    pub const VACUUM: Self = Self(1.0);

    /// The index itself.
    #[must_use]
    pub fn get(self) -> f64 {
        self.0
    }

    /// Germanium's at 2 µm: no transparent medium is known above it.
    pub const LARGEST_KNOWN: f64 = 4.1;

    /// True above [`Eta::LARGEST_KNOWN`].
    #[must_use]
    pub fn is_unusual(self) -> bool {
        self.0 > Self::LARGEST_KNOWN
    }
}

impl TryFrom<f64> for Eta {
    type Error = EtaError;

    fn try_from(value: f64) -> Result<Self, EtaError> {
        match value {
            v if v.is_finite() && v < 1.0 => Err(EtaError::BelowVacuum(v)),
            v if (1.0..=1e6).contains(&v) => Ok(Self(v)),
            v => Err(EtaError::OutOfRange(v)),
        }
    }
}

impl From<Eta> for f64 {
    fn from(eta: Eta) -> Self {
        eta.0
    }
}
