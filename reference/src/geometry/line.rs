//! A ray seen as a line: the shear that makes it the third axis, and how far
//! rounding can move things along it.
//!
//! Source: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
//! Intersection", JCGT 2(1), 2013.

use glam::{DVec2, DVec3};

/// Share of a coordinate's magnitude below which two places are "within
/// rounding": 2⁹ times the unit roundoff of f64.
pub(crate) const ROUNDING: f64 = 1.0 / (1u64 << 44) as f64;

/// A line with its shear. Positions along it are t times the unit direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) axes: [usize; 3],
    pub(crate) shear: DVec2,
    pub(crate) inverse_z: f64,
}

impl Line {
    #[inline]
    pub(crate) fn new(origin: DVec3, direction: DVec3) -> Self {
        let size = direction.abs();
        let z = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        let inverse_z = 1.0 / direction[z];
        Self {
            origin,
            direction,
            axes: [x, y, z],
            shear: DVec2::new(direction[x] * inverse_z, direction[y] * inverse_z),
            inverse_z,
        }
    }

    /// A vertex seen along the line: its place in the sheared plane, and t of
    /// the plane through it. Depends on the vertex alone, so every triangle
    /// around a vertex sees the same bits.
    #[inline(always)]
    pub(crate) fn see(&self, vertex: impl Fn(usize) -> f64) -> (DVec2, f64) {
        let [x, y, z] = self.axes;
        let depth = vertex(z) - self.origin[z];
        let across = DVec2::new(vertex(x) - self.origin[x], vertex(y) - self.origin[y]);
        (across - self.shear * depth, depth * self.inverse_z)
    }

    #[cfg(test)]
    pub(crate) fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }

    /// Distance along the line, perpendicular to a surface, that rounding can
    /// account for at t.
    #[inline]
    pub(crate) fn rounding_at(&self, t: f64) -> f64 {
        ROUNDING * (self.origin.abs().max_element() + t.abs())
    }
}
