//! One event: what a boundary does to a ray, and which normal decides it.

use crate::optics::interface::{fresnel, reflect, refract};
use crate::request::Fresnel;
use glam::DVec3;

/// Both continuations of a ray at a boundary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend {
    /// Share of the light that is reflected, 0 to 1; 1 under total reflection.
    pub(crate) reflectance: f64,
    pub(crate) reflected: DVec3,
    /// `None` under total reflection.
    pub(crate) transmitted: Option<DVec3>,
    /// The shading normal was replaced by the geometric one.
    pub(crate) geometric: bool,
}

/// The two normals at a point, both outward and unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceNormals {
    pub(crate) geometric: DVec3,
    pub(crate) shading: DVec3,
}

impl SurfaceNormals {
    pub(crate) fn are_apart(&self) -> bool {
        self.shading != self.geometric
    }
}

/// Bends a ray at a boundary.
///
/// If the shading normal does not face the ray, or sends either continuation to
/// the wrong side of the surface, the whole event uses the geometric normal.
///
/// * `d`: unit direction of travel.
/// * `entering`: the ray goes against the outward side; it comes from exact
///   geometry, so rounding in `d · n` cannot contradict it.
/// * `eta_i`, `eta_t`: absolute indices of the side the ray leaves and the side
///   it would enter.
/// * `model`: the formula of the reflectance.
pub(crate) fn bend(
    d: DVec3,
    normals: SurfaceNormals,
    entering: bool,
    [eta_i, eta_t]: [f64; 2],
    model: Fresnel,
) -> Bend {
    let face = |outward: DVec3| if entering { outward } else { -outward };
    let (flat, smooth) = (face(normals.geometric), face(normals.shading));
    if normals.are_apart() {
        if d.dot(smooth) < 0.0 {
            let bent = bend_at(d, smooth, [eta_i, eta_t], model);
            let right_side = bent.reflected.dot(flat) > 0.0
                && bent.transmitted.is_none_or(|transmitted| transmitted.dot(flat) < 0.0);
            if right_side {
                return bent;
            }
        }
        return Bend { geometric: true, ..bend_at(d, flat, [eta_i, eta_t], model) };
    }
    bend_at(d, flat, [eta_i, eta_t], model)
}

/// Crosses a parallel gap of air in a medium.
///
/// * `d`: unit direction of travel; `entering`: it goes against the outward side.
/// * `eta`: absolute index of the medium on both sides of the gap.
///
/// Light goes to and fro in the gap: R = 2 R₁ / (1 + R₁) with R₁ the
/// reflectance of one of its faces; what passes keeps its direction.
pub(crate) fn through_gap(d: DVec3, normals: SurfaceNormals, entering: bool, eta: f64) -> Bend {
    let faces = bend(d, normals, entering, [eta, 1.0], Fresnel::Exact);
    let reflectance = 2.0 * faces.reflectance / (1.0 + faces.reflectance);
    Bend { reflectance, transmitted: faces.transmitted.map(|_| d), ..faces }
}

/// Bends a ray at a boundary with one normal.
///
/// * `d`: unit direction of travel, towards the surface.
/// * `n`: unit normal on the side the ray comes from, so `d · n < 0`.
/// * `eta_i`, `eta_t`: absolute indices of the side the ray leaves and the side
///   it would enter.
fn bend_at(d: DVec3, n: DVec3, [eta_i, eta_t]: [f64; 2], model: Fresnel) -> Bend {
    let cos_i = (-d.dot(n)).clamp(0.0, 1.0);
    let transmitted = refract(d, n, eta_i, eta_t);
    let reflectance = match (transmitted, model) {
        (None, _) => 1.0,
        (_, Fresnel::Exact) => fresnel(cos_i, eta_i, eta_t),
        (Some(t), Fresnel::Schlick) => schlick(cos_i, -t.dot(n), eta_i, eta_t),
        (_, Fresnel::Cubic) => (1.0 - cos_i).powi(3),
    };
    let reflected = reflect(d, n).normalize();
    Bend { reflectance, reflected, transmitted, geometric: false }
}

/// Schlick's polynomial in the larger of the two angles: a share, 0 to 1.
///
/// * `cos_i`, `cos_t`: cosines of the angles of incidence and refraction, 0 to 1.
/// * `eta_i`, `eta_t`: absolute indices of the two sides.
///
/// Source: C. Schlick, "An Inexpensive BRDF Model for Physically-based
/// Rendering", Computer Graphics Forum 13(3), 1994.
fn schlick(cos_i: f64, cos_t: f64, eta_i: f64, eta_t: f64) -> f64 {
    let r0 = ((eta_i - eta_t) / (eta_i + eta_t)).powi(2);
    let cos = if eta_i > eta_t { cos_t } else { cos_i };
    r0 + (1.0 - r0) * (1.0 - cos).powi(5)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Light that goes to and fro in the gap adds up: with one face reflecting
    /// R, the sum R + (1 - R)² R (1 + R² + R⁴ + …) is 2 R / (1 + R).
    #[test]
    fn a_gap_reflects_what_its_two_faces_do() {
        let up = SurfaceNormals { geometric: DVec3::Z, shading: DVec3::Z };
        for degrees in [0.0_f64, 20.0, 40.0, 49.0, 50.0, 80.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let d = DVec3::new(sin, 0.0, -cos);
            let (gap, face) = (through_gap(d, up, true, 1.309), fresnel(cos, 1.309, 1.0));
            let mut sum = face;
            let mut inside = (1.0 - face) * (1.0 - face);
            for _ in 0..2000 {
                sum += inside * face;
                inside *= face * face;
            }
            assert!((gap.reflectance - sum).abs() < 1e-12, "{degrees}");
            assert_eq!(gap.transmitted, (degrees < 49.8).then_some(d));
        }
    }
}
