//! The angle between the directions in which light leaves a body: the error
//! that refraction makes before any environment colours it.

use crate::support::sum::{mean, quantile};

/// Angle between two directions of any length, radians, 0 to π:
/// atan2(|a x b|, a · b), which keeps its digits near 0 and π where the arc
/// cosine loses half of them.
#[must_use]
pub fn angle_rad(a: [f64; 3], b: [f64; 3]) -> f64 {
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    cross.iter().map(|c| c * c).sum::<f64>().sqrt().atan2(dot)
}

/// Angle at each pixel, degrees; NaN where one of the two has no exit (zero
/// vector). `reference` and `candidate` are interleaved X, Y, Z.
#[must_use]
pub fn exit_angle_map_deg(reference: &[f64], candidate: &[f64]) -> Vec<f64> {
    let pixels = reference.chunks_exact(3).zip(candidate.chunks_exact(3));
    pixels
        .map(|(r, t)| match (vector(r), vector(t)) {
            (Some(r), Some(t)) => angle_rad(r, t).to_degrees(),
            _ => f64::NAN,
        })
        .collect()
}

fn vector(xyz: &[f64]) -> Option<[f64; 3]> {
    let v = [xyz[0], xyz[1], xyz[2]];
    (v != [0.0; 3]).then_some(v)
}

/// What the angles of an image say together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExitAngles {
    /// Pixels in which both chains leave.
    pub n: usize,
    /// Mean, degrees.
    pub mean_deg: f64,
    /// Median, degrees.
    pub median_deg: f64,
    /// 95th percentile, degrees.
    pub p95_deg: f64,
    /// Share of the pixels within 1 degree, 0..1; higher is better.
    pub share_within_1_deg: f64,
}

/// Summary of the angles that exist (NaN = none); `None` when there is none.
#[must_use]
pub fn summarise(angles_deg: impl IntoIterator<Item = f64>) -> Option<ExitAngles> {
    let mut angles: Vec<f64> = angles_deg.into_iter().filter(|a| !a.is_nan()).collect();
    angles.sort_unstable_by(f64::total_cmp);
    let within = angles.partition_point(|&angle| angle <= 1.0);
    Some(ExitAngles {
        n: angles.len(),
        median_deg: quantile(&angles, 0.5)?,
        p95_deg: quantile(&angles, 0.95)?,
        mean_deg: mean(angles.iter().copied()),
        share_within_1_deg: within as f64 / angles.len() as f64,
    })
}

/// Share of the pixels with an exit on exactly one side among those with an
/// exit on any: where the two do not even agree that light leaves. `None`
/// when no pixel has an exit.
#[must_use]
pub fn unmatched_share(reference: &[f64], candidate: &[f64]) -> Option<f64> {
    let (mut any, mut one) = (0usize, 0usize);
    for (r, t) in reference.chunks_exact(3).zip(candidate.chunks_exact(3)) {
        let (r, t) = (vector(r).is_some(), vector(t).is_some());
        any += usize::from(r || t);
        one += usize::from(r != t);
    }
    (any > 0).then(|| one as f64 / any as f64)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;

    fn at(degrees: f64) -> [f64; 3] {
        let angle = degrees.to_radians();
        [angle.sin(), 0.0, angle.cos()]
    }

    #[test]
    fn angles_are_exact_from_a_nanodegree_to_the_opposite() {
        for degrees in [1e-9, 1e-4, 1.0, 45.0, 90.0, 179.999_999] {
            let found = angle_rad([0.0, 0.0, 3.0], at(degrees)).to_degrees();
            assert!((found - degrees).abs() < 1e-14 * degrees.max(1.0) * 10.0, "{found}");
        }
        let acos = at(1e-9)[2].acos().to_degrees();
        assert!((acos - 1e-9).abs() > 1e-10, "the arc cosine loses the nanodegree");
    }

    #[test]
    fn a_summary_counts_only_pixels_where_both_leave() {
        let reference = [at(0.0), at(0.0), at(0.0), [0.0; 3]].concat();
        let candidate = [at(0.5), at(3.0), [0.0; 3], at(90.0)].concat();
        let angles = exit_angle_map_deg(&reference, &candidate);
        let summary = summarise(angles).unwrap();
        assert_eq!(summary.n, 2);
        assert!((summary.mean_deg - 1.75).abs() < 1e-12);
        assert!((summary.median_deg - 1.75).abs() < 1e-12);
        assert_eq!(summary.share_within_1_deg, 0.5);
        assert_eq!(unmatched_share(&reference, &candidate).unwrap(), 0.5);
        assert!(summarise([f64::NAN]).is_none());
    }
}
