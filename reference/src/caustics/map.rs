//! Reading a map: from a file's numbers, and at points of the receiver.

use super::face::Face;
use super::{Balance, CausticMap};
use crate::error::Error;
use glam::DVec3;
use scenes::Scene;

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
        let [u, v] = self.face.place(point, outward)?;
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
