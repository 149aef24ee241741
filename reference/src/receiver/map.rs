//! A map of the light on an object's face, and what it says at points of it.

use crate::error::Error;
use crate::receiver::face::Face;
use glam::DVec3;
use scenes::Scene;
use std::fmt;

/// Power by where it went, summed over photons, linear R, G, B.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Balance {
    /// Left the lights towards the sphere around receiver and glass, in watts if
    /// the lights are in watts.
    pub emitted: DVec3,
    /// Arrived on the receiver's face.
    pub deposited: DVec3,
    /// Was absorbed in media or on opaque surfaces.
    pub absorbed: DVec3,
    /// Left the scene.
    pub escaped: DVec3,
    /// Was dropped after 20,000 events.
    pub dropped: DVec3,
}

/// Irradiance on a receiver's face.
#[derive(Clone, PartialEq)]
pub struct CausticMap {
    /// Index of the receiver.
    pub receiver: usize,
    /// Bins along columns (+x of a box) and rows (+z).
    pub size_bins: [u32; 2],
    /// Irradiance per bin, W/m² in the scene's units, rows one after the other.
    pub irradiance: Vec<DVec3>,
    /// Variance of that irradiance.
    pub variance: Vec<DVec3>,
    /// Where the power went.
    pub balance: Balance,
    pub(crate) face: Face,
}

impl fmt::Debug for CausticMap {
    /// Short, and different for maps that differ.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sum: DVec3 = self.irradiance.iter().sum();
        write!(f, "CausticMap({} {:?} {sum:?})", self.receiver, self.size_bins)
    }
}

impl CausticMap {
    /// A map that was written before, for the same scene, receiver and frame.
    ///
    /// # Errors
    /// The receiver is no opaque face, or the numbers do not fill the bins.
    pub fn from_irradiance(
        scene: &Scene,
        receiver: usize,
        frame: u32,
        size_bins: [u32; 2],
        irradiance: Vec<DVec3>,
    ) -> Result<Self, Error> {
        let face = Face::of(scene, receiver, frame)?;
        if irradiance.len() as u64 != u64::from(size_bins[0]) * u64::from(size_bins[1]) {
            let value = irradiance.len().to_string();
            let name = "values of irradiance";
            return Err(Error::Range { name, value, range: "one per bin" });
        }
        let variance = vec![DVec3::ZERO; irradiance.len()];
        let balance = Balance::default();
        Ok(Self { receiver, size_bins, irradiance, variance, balance, face })
    }

    /// Irradiance at a point of the face, linear between the centres of bins;
    /// `None` if a surface with this outward normal is another side.
    pub(crate) fn at(&self, point: DVec3, outward: DVec3) -> Option<DVec3> {
        let [u, v] = self.face.shares_at(point, outward)?;
        let [columns, rows] = self.size_bins.map(|n| n as usize);
        let split = |share: f64, count: usize| {
            let at = (share * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
            let low = (at as usize).min(count.saturating_sub(2));
            (low, (low + 1).min(count - 1), at - low as f64)
        };
        let ((left, right, fx), (top, bottom, fy)) = (split(u, columns), split(v, rows));
        let row = |y: usize| {
            let [a, b] = [left, right].map(|x| self.irradiance[y * columns + x]);
            a.lerp(b, fx)
        };
        Some(row(top).lerp(row(bottom), fy))
    }
}
