//! Light at a smooth boundary between two media.
//!
//! Source: M. Born, E. Wolf, "Principles of Optics", 7th ed., 1.5. Written so
//! that nothing cancels: near equal indices, at grazing incidence and at the
//! critical angle the results keep their relative accuracy.

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
///
/// * `cos_i`: cosine of the angle of incidence, 0 to 1.
/// * `eta_i`, `eta_t`: absolute indices of the side the light comes from and the
///   side it would enter.
#[must_use]
pub fn fresnel(cos_i: f64, eta_i: f64, eta_t: f64) -> f64 {
    match amplitudes(cos_i, eta_i, eta_t) {
        Amplitudes::Partial { s, p } => 0.5 * (s * s + p * p),
        Amplitudes::Total { .. } => 1.0,
    }
}

/// What a boundary does to the two polarisations: the electric field across
/// (s) and in (p) the plane of incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amplitudes {
    /// Amplitudes of the reflected field over the incident one. Head-on their
    /// signs differ: the axes of s, p and the direction of travel are
    /// right-handed before and after.
    Partial {
        /// Across the plane of incidence.
        s: f64,
        /// In the plane of incidence.
        p: f64,
    },
    /// Everything is reflected; s and p come apart in phase.
    Total {
        /// Phase of s less that of p, radians.
        retardance: f64,
    },
}

/// Fresnel's amplitudes at a boundary.
///
/// * `cos_i`: cosine of the angle of incidence, 0 to 1.
/// * `eta_i`, `eta_t`: absolute indices of the side the light comes from and the
///   side it would enter.
#[must_use]
pub fn amplitudes(cos_i: f64, eta_i: f64, eta_t: f64) -> Amplitudes {
    let eta_i_over_t = eta_i / eta_t;
    let sin2_i = (1.0 - cos_i) * (1.0 + cos_i);
    let sin_t = eta_i_over_t * sin2_i.max(0.0).sqrt();
    if sin_t >= 1.0 {
        // tan(δ/2) = cos θ √(sin² θ - n²) / sin² θ.
        let beyond = ((sin_t - 1.0) * (sin_t + 1.0)).sqrt() / eta_i_over_t;
        let retardance = 2.0 * (cos_i * beyond).atan2(sin2_i);
        return Amplitudes::Total { retardance };
    }
    let cos_t = ((1.0 - sin_t) * (1.0 + sin_t)).sqrt();
    let sum = eta_i * cos_i + eta_t * cos_t;
    // n₁² cos² θ₁ - n₂² cos² θ₂ = n₁² - n₂² by Snell's law.
    let s = (eta_i - eta_t) * (eta_i + eta_t) / (sum * sum);
    // r_p = -r_s cos(θ₁ + θ₂) / cos(θ₁ - θ₂).
    let (cosines, sines) = (cos_i * cos_t, eta_i_over_t * sin2_i);
    let p = -s * (cosines - sines) / (cosines + sines);
    Amplitudes::Partial { s, p }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const INDICES: [f64; 4] = [1.309, 4.0 / 3.0, 1.5, 2.417];

    fn at(sin: f64) -> DVec3 {
        DVec3::new(sin, 0.0, -(1.0 - sin * sin).sqrt())
    }

    #[test]
    fn total_reflection_begins_at_the_critical_angle() {
        for (eta, degrees) in INDICES.into_iter().zip([49.813, 48.590, 41.810, 24.440]) {
            assert!((f64::asin(1.0 / eta).to_degrees() - degrees).abs() < 5.1e-4);
            let sin = 1.0 / eta;
            assert!(refract(at(sin * (1.0 - 1e-12)), DVec3::Z, eta, 1.0).is_some());
            assert!(refract(at(sin * (1.0 + 1e-12)), DVec3::Z, eta, 1.0).is_none());
            // The transmitted ray runs along the surface.
            let along = refract(at(sin * (1.0 - 1e-15)), DVec3::Z, eta, 1.0);
            assert!(along.is_none_or(|t| t.z.abs() < 1e-7 && t.z <= 0.0));
        }
    }

    #[test]
    fn nothing_in_the_plane_of_incidence_is_reflected_at_brewsters_angle() {
        for (eta, degrees) in INDICES.into_iter().zip([52.622, 53.130, 56.310, 67.523]) {
            let angle = eta.atan();
            assert!((angle.to_degrees() - degrees).abs() < 5.1e-4);
            let Amplitudes::Partial { s, p } = amplitudes(angle.cos(), 1.0, eta) else {
                unreachable!()
            };
            assert!(p * p < 1e-30 && s * s > 0.01);
        }
    }

    #[test]
    fn head_on_the_reflectance_is_that_of_the_textbook() {
        for (eta, share) in [(1.309, 0.017_909), (1.5, 0.04), (2.417, 0.171_969)] {
            assert!((fresnel(1.0, 1.0, eta) - share).abs() < 5.1e-7, "{eta}");
            assert!((fresnel(1.0, eta, 1.0) - share).abs() < 5.1e-7, "{eta}");
        }
    }

    /// Mean over a diffuse sky, 2 ∫ R cos θ d cos θ, from outside and inside.
    #[test]
    fn the_reflectance_of_diffuse_light_is_the_tabulated_one() {
        for (eta, outside, inside) in [
            (1.309, 0.062_581, 0.452_916),
            (1.5, 0.091_778, 0.596_346),
            (2.417, 0.212_188, 0.865_144),
        ] {
            let mean = |from: f64, to: f64| {
                let steps = 200_000;
                let of = |i| (f64::from(i) + 0.5) / f64::from(steps);
                let sum: f64 = (0..steps).map(|i| 2.0 * of(i) * fresnel(of(i), from, to)).sum();
                sum / f64::from(steps)
            };
            assert!((mean(1.0, eta) - outside).abs() < 1e-6, "{eta}");
            assert!((mean(eta, 1.0) - inside).abs() < 1e-6, "{eta}");
        }
    }

    /// A retardance of 45° per reflection in glass of 1.51, at 54°37' (Fresnel's
    /// rhomb; Born & Wolf, 1.5.4).
    #[test]
    fn fresnels_rhomb_turns_by_an_eighth() {
        let angle = (54.0 + 37.0 / 60.0_f64).to_radians();
        let Amplitudes::Total { retardance } = amplitudes(angle.cos(), 1.51, 1.0) else {
            unreachable!()
        };
        assert!((retardance.to_degrees() - 45.0).abs() < 0.03, "{retardance}");
    }

    #[test]
    fn towards_grazing_everything_is_reflected_monotonically() {
        let mut last = 0.0;
        for k in 1..=12 {
            let share = fresnel(10.0_f64.powi(-k).to_radians().sin(), 1.0, 1.5);
            assert!(share > last && share < 1.0, "{k}");
            last = share;
        }
        assert!(last > 1.0 - 1e-12);
    }

    proptest! {
        /// Transmitted power from the transmitted amplitudes, not as 1 - R.
        #[test]
        fn what_is_not_reflected_is_transmitted(
            cos_i in 1e-6..1.0_f64, eta_i in 1.0..4.0_f64, eta_t in 1.0..4.0_f64,
        ) {
            if let Amplitudes::Partial { s, p } = amplitudes(cos_i, eta_i, eta_t) {
                let sin_t = eta_i / eta_t * (1.0 - cos_i * cos_i).sqrt();
                let cos_t = ((1.0 - sin_t) * (1.0 + sin_t)).sqrt();
                let (a, b) = (eta_i * cos_i, eta_t * cos_t);
                let t_s = 2.0 * a / (a + b);
                let t_p = 2.0 * a / (eta_t * cos_i + eta_i * cos_t);
                let power = b / a;
                // Where cos θ₂ itself is lost to rounding the sum is too.
                let within = 1e-14 + 4e-16 / (cos_t * cos_t);
                prop_assert!((s * s + power * t_s * t_s - 1.0).abs() < within);
                prop_assert!((p * p + power * t_p * t_p - 1.0).abs() < within);
            }
        }

        #[test]
        fn a_boundary_reflects_alike_from_both_sides(
            cos_i in 1e-6..1.0_f64, eta_i in 1.0..4.0_f64, eta_t in 1.0..4.0_f64,
        ) {
            let d = at((1.0 - cos_i * cos_i).sqrt());
            if let Some(t) = refract(d, DVec3::Z, eta_i, eta_t) {
                let (there, back) = (fresnel(-d.z, eta_i, eta_t), fresnel(-t.z, eta_t, eta_i));
                // The angle is known to 1e-16, its cosine less well where it is small.
                let within = 1e-13 / d.z.abs().min(t.z.abs()).max(1e-9);
                prop_assert!((there - back).abs() < within);
                // The way back is the way there, as far as the angle is known.
                let again = refract(-t, -DVec3::Z, eta_t, eta_i);
                let within = 1e-12 / d.z.abs().min(t.z.abs()).max(1e-9);
                prop_assert!(again.is_some_and(|again| (again + d).length() < within));
            }
        }
    }
}
