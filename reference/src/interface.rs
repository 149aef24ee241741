//! Light at a smooth boundary between two media.

use glam::DVec3;

/// Mirrors a direction of travel in a surface with unit normal `n`.
#[must_use]
pub fn reflect(d: DVec3, n: DVec3) -> DVec3 {
    d - n * (2.0 * d.dot(n))
}

/// Direction of the ray after it crosses the boundary, or `None` when it is
/// totally reflected (an answer, not a failure).
///
/// * `d`: unit direction of travel, towards the surface, world space.
/// * `n`: unit normal on the side the ray comes from, so `d · n < 0`.
/// * `eta_i`, `eta_t`: absolute indices of the side the ray leaves and the side
///   it would enter.
#[must_use]
pub fn refract(d: DVec3, n: DVec3, eta_i: f64, eta_t: f64) -> Option<DVec3> {
    let eta_i_over_t = eta_i / eta_t;
    let cos_i = -d.dot(n);
    let tangent = (d + n * cos_i) * eta_i_over_t;
    let cos2_t = 1.0 - tangent.length_squared();
    (cos2_t > 0.0).then(|| (tangent - n * cos2_t.sqrt()).normalize())
}

/// Share of unpolarised light that a boundary reflects; 1 under total reflection.
#[must_use]
pub fn fresnel(cos_i: f64, eta_i: f64, eta_t: f64) -> f64 {
    let sin_t = eta_i / eta_t * (1.0 - cos_i * cos_i).max(0.0).sqrt();
    if sin_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin_t * sin_t).sqrt();
    let s = (eta_i * cos_i - eta_t * cos_t) / (eta_i * cos_i + eta_t * cos_t);
    let p = (eta_t * cos_i - eta_i * cos_t) / (eta_t * cos_i + eta_i * cos_t);
    0.5 * (s * s + p * p)
}
