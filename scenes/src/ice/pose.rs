//! Seeded positions and orientations of what lies inside a body.

use crate::noise::SplitMix64;
use glam::{DAffine3, DQuat, DVec3};
use std::f64::consts::TAU;

/// Uniformly distributed rotation.
///
/// Source: Shoemake, "Uniform random rotations", *Graphics Gems III*, 1992.
pub(crate) fn rotation(random: &mut SplitMix64) -> DQuat {
    let [u, v, w] = [random.uniform(), random.uniform(), random.uniform()];
    let (sin_v, cos_v) = (TAU * v).sin_cos();
    let (sin_w, cos_w) = (TAU * w).sin_cos();
    let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
    DQuat::from_xyzw(a * sin_v, a * cos_v, b * sin_w, b * cos_w)
}

/// Normally distributed offset with deviation `sigma_m` along each axis, drawn
/// again until its length is at most `limit_m`.
pub(crate) fn offset(random: &mut SplitMix64, sigma_m: f64, limit_m: f64) -> DVec3 {
    // A draw exceeds 2.5 sigma with probability 0.1: 64 in a row do not happen.
    (0..64)
        .map(|_| sigma_m * DVec3::new(random.normal(), random.normal(), random.normal()))
        .find(|offset| offset.length() <= limit_m)
        .unwrap_or(DVec3::ZERO)
}

/// Body space from a unit shape's space.
pub(crate) fn placed(scale_m: f64, rotation: DQuat, centre_m: DVec3) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(DVec3::splat(scale_m), rotation, centre_m)
}

/// Centre and diagonal of a bounding box.
pub(crate) fn centre_and_diagonal(bounds: [DVec3; 2]) -> (DVec3, f64) {
    (0.5 * (bounds[0] + bounds[1]), bounds[0].distance(bounds[1]))
}
