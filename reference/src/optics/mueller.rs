//! Polarised light: Mueller matrices of boundaries, and frames to state them in.
//!
//! Source: E. Hecht, "Optics", 5th ed., 8.13; M. Born, E. Wolf, "Principles of
//! Optics", 7th ed., 1.5. Stokes vectors (I, Q, U, V) refer to an axis across
//! the direction of travel `k`; axis, k x axis and k are right-handed. Where a
//! boundary's plane of incidence matters, the axis is the one across that plane.

use crate::optics::interface::Amplitudes;
use glam::{DMat4, DVec3, DVec4};

/// What a boundary does to light that is reflected at it and that passes it,
/// for an axis across the plane of incidence.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Boundary {
    pub(crate) reflected: DMat4,
    /// Zero under total reflection.
    pub(crate) transmitted: DMat4,
}

/// The matrix of what changes the two polarisations differently.
///
/// * `s`, `p`: shares of power that remain across and in the plane of incidence.
/// * `product`: of the factors of the two amplitudes.
/// * `phase`: of s less that of p, radians.
fn diattenuator(s: f64, p: f64, product: f64, phase: f64) -> DMat4 {
    let (mean, half) = (0.5 * (s + p), 0.5 * (s - p));
    let (sin, cos) = phase.sin_cos();
    DMat4::from_cols(
        DVec4::new(mean, half, 0.0, 0.0),
        DVec4::new(half, mean, 0.0, 0.0),
        DVec4::new(0.0, 0.0, product * cos, product * sin),
        DVec4::new(0.0, 0.0, -product * sin, product * cos),
    )
}

impl Boundary {
    /// One surface between two media.
    pub(crate) fn surface(amplitudes: Amplitudes) -> Self {
        match amplitudes {
            Amplitudes::Partial { s, p } => {
                let (r_s, r_p) = (s * s, p * p);
                let (t_s, t_p) = (1.0 - r_s, 1.0 - r_p);
                Self {
                    reflected: diattenuator(r_s, r_p, s * p, 0.0),
                    transmitted: diattenuator(t_s, t_p, (t_s * t_p).sqrt(), 0.0),
                }
            }
            Amplitudes::Total { retardance } => Self {
                reflected: diattenuator(1.0, 1.0, 1.0, retardance),
                transmitted: DMat4::ZERO,
            },
        }
    }

    /// A thin gap with such a surface on either side; light goes to and fro in
    /// it without interference.
    pub(crate) fn gap(amplitudes: Amplitudes) -> Self {
        let Amplitudes::Partial { s, p } = amplitudes else { return Self::surface(amplitudes) };
        let (r_s, r_p, both) = (s * s, p * p, s * p);
        let through = (1.0 - r_s) * (1.0 - r_p) / (1.0 - both * both);
        let (back_s, back_p) = (2.0 * r_s / (1.0 + r_s), 2.0 * r_p / (1.0 + r_p));
        Self {
            reflected: diattenuator(back_s, back_p, both * (1.0 + through), 0.0),
            transmitted: diattenuator(1.0 - back_s, 1.0 - back_p, through, 0.0),
        }
    }
}

/// Restates light that travels along `k` from one axis to another; both are
/// unit and across `k`.
pub(crate) fn restate(from: DVec3, to: DVec3, k: DVec3) -> DMat4 {
    let (cos, sin) = (to.dot(from), to.dot(k.cross(from)));
    let (cos2, sin2) = (cos * cos - sin * sin, 2.0 * sin * cos);
    DMat4::from_cols(
        DVec4::X,
        DVec4::new(0.0, cos2, -sin2, 0.0),
        DVec4::new(0.0, sin2, cos2, 0.0),
        DVec4::W,
    )
}

/// Unit vector across the plane of incidence; any across `d` head-on, where the
/// plane is undefined and does not matter.
pub(crate) fn across(d: DVec3, normal: DVec3) -> DVec3 {
    d.cross(normal).try_normalize().unwrap_or_else(|| d.any_orthonormal_vector())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::interface::amplitudes;

    #[test]
    fn nothing_is_lost_at_a_boundary() {
        for make in [Boundary::surface, Boundary::gap] {
            for cos in [1.0, 0.9, 0.7, 0.5, 0.1] {
                let boundary = make(amplitudes(cos, 1.5, 1.0));
                let sum = boundary.reflected.x_axis + boundary.transmitted.x_axis;
                assert!((sum - DVec4::X).length() < 1e-14, "{cos}: {sum}");
            }
        }
    }

    /// Two total reflections at 54°37' in glass of 1.51 make circular light of
    /// linear light at 45° (Fresnel's rhomb), and not at 45° incidence.
    #[test]
    fn fresnels_rhomb_makes_circular_light() {
        let circular = |degrees: f64| {
            let once = Boundary::surface(amplitudes(degrees.to_radians().cos(), 1.51, 1.0));
            let light = once.reflected * (once.reflected * DVec4::new(1.0, 0.0, 1.0, 0.0));
            assert!((light.truncate().length().hypot(light.w) - 2.0_f64.sqrt()).abs() < 1e-12);
            light.w.abs()
        };
        assert!(circular(54.0 + 37.0 / 60.0) > 0.999_99);
        assert!(circular(45.0) < 0.99);
    }

    #[test]
    fn linear_light_at_an_angle_is_found_at_that_angle() {
        let (k, x) = (DVec3::Z, DVec3::X);
        let turned = DVec3::new(30.0_f64.to_radians().cos(), 30.0_f64.to_radians().sin(), 0.0);
        let seen = restate(turned, x, k) * DVec4::new(1.0, 1.0, 0.0, 0.0);
        let (sin, cos) = 60.0_f64.to_radians().sin_cos();
        assert!((seen - DVec4::new(1.0, cos, sin, 0.0)).length() < 1e-15, "{seen}");
        let back = restate(x, turned, k) * seen;
        assert!((back - DVec4::new(1.0, 1.0, 0.0, 0.0)).length() < 1e-15);
    }
}
