//! A line as the boxes see it: f32, with its rounding on the side of a hit.

use super::node::Unit;
use crate::geometry::line::Line;

/// For each axis, plane · `inverse` + `enter` is not after the line's passage
/// through that plane, and plane · `inverse` + `leave` not before it.
///
/// With |plane| ≤ 1, M = 1 + max |origin| and t in unit coordinates, f32
/// arithmetic (two roundings, and those of the constants) is off by at most
/// 2.5 · 2⁻²³ M |inverse|; the constants are moved by 2⁻²¹ M |inverse|, so what
/// remains covers the f64 rounding of the triangles many times over.
///
/// |inverse| is capped at 2²⁶. A line that hardly moves along an axis then
/// still spans all of the scene in a slab that it is in, because the shift by
/// 2⁻²¹ M is stretched to 2⁵ M, more than the |t| ≤ 4 M of any crossing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxRay {
    pub(crate) inverse: [f32; 3],
    pub(crate) enter: [f32; 3],
    pub(crate) leave: [f32; 3],
    /// Which plane is met first: 1 for the upper.
    pub(crate) first: [usize; 3],
    per_metre: f64,
}

const MOST_INVERSE: f32 = (1u32 << 26) as f32;
const SLACK: f64 = 1.0 / (1u64 << 21) as f64;

impl BoxRay {
    #[inline(always)]
    pub(crate) fn new(line: &Line, unit: &Unit) -> Self {
        let origin = unit.of(line.origin);
        let slack = SLACK * (1.0 + origin.abs().max_element());
        let mut ray = Self {
            inverse: [0.0; 3],
            enter: [0.0; 3],
            leave: [0.0; 3],
            first: [0; 3],
            per_metre: unit.per_metre,
        };
        for axis in 0..3 {
            let inverse = (line.direction[axis] as f32).recip();
            let inverse = inverse.clamp(-MOST_INVERSE, MOST_INVERSE);
            let (at, shift) =
                (-origin[axis] * f64::from(inverse), slack * f64::from(inverse.abs()));
            ray.inverse[axis] = inverse;
            ray.enter[axis] = (at - shift) as f32;
            ray.leave[axis] = (at + shift) as f32;
            ray.first[axis] = usize::from(inverse < 0.0);
        }
        ray
    }

    /// True unless the line is no line: not finite, or hardly of unit direction,
    /// or so far away that f32 cannot say where.
    #[inline(always)]
    pub(crate) fn is_usable(&self) -> bool {
        let finite = |x: [f32; 3]| x.iter().all(|x| x.is_finite());
        finite(self.enter) && finite(self.leave) && self.inverse.iter().all(|x| x.abs() > 0.5)
    }

    /// A distance along the line in unit coordinates, not after `t`.
    #[inline(always)]
    pub(crate) fn not_after(&self, t: f64) -> f32 {
        let near = (t * self.per_metre) as f32;
        near - near.abs() * f32::EPSILON
    }

    /// A distance along the line in unit coordinates, not before `t`.
    #[inline(always)]
    pub(crate) fn not_before(&self, t: f64) -> f32 {
        let near = (t * self.per_metre) as f32;
        near + near.abs() * f32::EPSILON
    }
}
