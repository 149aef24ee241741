//! On which side of an edge a line passes, decided exactly.
//!
//! The line is the origin of the sheared plane. A line through the edge itself
//! is moved by (δx, δy), δx ≫ δy > 0, both smaller than any number: the same
//! for every edge, so along a full line the signed crossings of a closed mesh
//! always sum to zero. Source: H. Edelsbrunner, E. Mücke, "Simulation of
//! Simplicity", ACM TOG 9(1), 1990.

use glam::DVec2;

/// a × b where the products differ; its sign is exact, because rounding is
/// monotone. Zero where it takes [`resolve`] to know.
#[inline(always)]
pub(crate) fn cross(a: DVec2, b: DVec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// a × b with an exact sign bit; ±0.0 where the value is zero and the
/// perturbation decides. Antisymmetric in a and b unless they coincide.
#[cold]
pub(crate) fn resolve(a: DVec2, b: DVec2) -> f64 {
    let (p, q) = (a.x * b.y, a.y * b.x);
    if p != q {
        return p - q;
    }
    // What rounding took from each product, exactly.
    let (rest_p, rest_q) = (a.x.mul_add(b.y, -p), a.y.mul_add(b.x, -q));
    if rest_p != rest_q {
        return rest_p - rest_q;
    }
    let towards = if a.y == b.y { b.x - a.x } else { a.y - b.y };
    0.0_f64.copysign(towards)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integers below 2^53 scaled so that their products need 104 bits: the
    /// sign agrees with integer arithmetic where f64 alone sees a tie.
    #[test]
    fn the_sign_is_that_of_exact_arithmetic() {
        let mut state = 7_u64;
        let mut ties = 0;
        for _ in 0..200_000 {
            let mut draw = || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (state >> 12) as i64
            };
            let (x, y) = (draw(), draw());
            // Nearly parallel: b is a multiple of a off by at most one unit.
            let (s, dx, dy) = (draw() % 3 + 1, draw() % 2, draw() % 2);
            let (bx, by) = ((x / 4) * s + dx, (y / 4) * s + dy);
            let exact = i128::from(x) * i128::from(by) - i128::from(y) * i128::from(bx);
            let a = DVec2::new(x as f64, y as f64);
            let b = DVec2::new(bx as f64, by as f64);
            if cross(a, b) == 0.0 {
                ties += 1;
            }
            if exact != 0 {
                assert_eq!(resolve(a, b) > 0.0, exact > 0, "{a} {b}");
            }
        }
        assert!(ties > 100, "the plain product must tie somewhere: {ties}");
    }

    #[test]
    fn swapping_the_ends_flips_the_sign_on_the_edge_too() {
        for (a, b) in [
            (DVec2::new(-1.0, 0.0), DVec2::new(2.0, 0.0)),
            (DVec2::new(0.0, -1.0), DVec2::new(0.0, 3.0)),
            (DVec2::new(1.0, 1.0), DVec2::new(-3.0, -3.0)),
            (DVec2::ZERO, DVec2::new(1.0, 5.0)),
        ] {
            assert_eq!(resolve(a, b), 0.0);
            assert_ne!(resolve(a, b).is_sign_negative(), resolve(b, a).is_sign_negative());
        }
    }
}
