//! Student's t distribution, for any level and any number of degrees of freedom.

/// More degrees of freedom than this are as good as infinitely many: the
/// quantiles differ from those of the normal distribution by less than 1e-5.
const MOST: f64 = 1e6;

/// Probability that Student's t with that many degrees of freedom exceeds `t`.
///
/// Half of the regularised incomplete beta function I_x(ν/2, 1/2) at
/// x = ν / (ν + t²), NIST DLMF §8.17. ν need not be whole (Welch's need not be);
/// infinite is allowed.
#[must_use]
pub fn student_tail(t: f64, degrees_of_freedom: f64) -> f64 {
    if t.is_nan() || degrees_of_freedom.is_nan() || degrees_of_freedom <= 0.0 {
        return f64::NAN;
    }
    let v = degrees_of_freedom.min(MOST);
    let half = 0.5 * incomplete_beta(v / (v + t * t), 0.5 * v, 0.5);
    if t >= 0.0 { half } else { 1.0 - half }
}

/// The t that is exceeded with probability `tail`, 0 < tail < 1.
#[must_use]
pub fn student_quantile(tail: f64, degrees_of_freedom: f64) -> f64 {
    let tail_known = tail > 0.0 && tail < 1.0;
    if !tail_known || degrees_of_freedom.is_nan() || degrees_of_freedom <= 0.0 {
        return f64::NAN;
    }
    let (mut low, mut high) = (-1.0, 1.0);
    while student_tail(low, degrees_of_freedom) < tail {
        low *= 2.0;
    }
    while student_tail(high, degrees_of_freedom) > tail {
        high *= 2.0;
    }
    // The tail falls with t; 80 halvings leave nothing of any bracket.
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if student_tail(middle, degrees_of_freedom) > tail {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The regularised incomplete beta function I_x(a, b), by the continued
/// fraction of DLMF 8.17.22, evaluated by Lentz's method.
fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    // The fraction converges fast below this point; above it, its mirror does.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    let front = (a * x.ln() + b * (-x).ln_1p() + ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b)).exp();
    front / (a * fraction(x, a, b))
}

/// 1 + d1 / (1 + d2 / (1 + ...)), the denominator of DLMF 8.17.22.
fn fraction(x: f64, a: f64, b: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let away = |value: f64| if value.abs() < TINY { TINY } else { value };
    let (mut value, mut over, mut under) = (1.0, 1.0, 0.0);
    for n in 1..2_000u32 {
        let m = f64::from(n / 2);
        let d = if n % 2 == 0 {
            m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m))
        } else {
            -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
        };
        over = away(1.0 + d / over);
        under = 1.0 / away(1.0 + d * under);
        let step = over * under;
        value *= step;
        if (step - 1.0).abs() < 1e-15 {
            break;
        }
    }
    value
}

/// ln Γ(x) for x > 0: Stirling's series (DLMF 5.11.1) beyond 20, reached by
/// Γ(x + 1) = x Γ(x).
fn ln_gamma(x: f64) -> f64 {
    let (mut x, mut product) = (x, 1.0f64);
    while x < 20.0 {
        product *= x;
        x += 1.0;
    }
    let inverse = 1.0 / x;
    let square = inverse * inverse;
    let series = inverse
        * (1.0 / 12.0 - square * (1.0 / 360.0 - square * (1.0 / 1260.0 - square * (1.0 / 1680.0))));
    (x - 0.5) * x.ln() - x + 0.5 * std::f64::consts::TAU.ln() + series - product.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz & Stegun, *Handbook of Mathematical Functions*, table 26.10.
    #[test]
    fn quantiles_are_those_of_the_table() {
        let table = [
            (0.025, 1.0, 12.706),
            (0.025, 2.0, 4.303),
            (0.025, 10.0, 2.228),
            (0.01, 4.0, 3.747),
            (0.005, 15.0, 2.947),
            (0.0005, 30.0, 3.646),
            (0.025, f64::INFINITY, 1.960),
            (0.005, f64::INFINITY, 2.576),
        ];
        for (tail, freedom, t) in table {
            let found = student_quantile(tail, freedom);
            assert!((found - t).abs() < 6e-4, "{tail} {freedom}: {found} is not {t}");
            assert!((student_tail(found, freedom) - tail).abs() < 1e-12);
            assert!((student_quantile(1.0 - tail, freedom) + t).abs() < 6e-4, "{tail}, mirrored");
        }
    }

    /// With one degree of freedom it is Cauchy's distribution, with two it is
    /// 1/2 - t / (2 √(2 + t²)): both in closed form.
    #[test]
    fn few_degrees_of_freedom_have_closed_forms() {
        for t in [-3.0, -0.1, 0.0, 0.5, 2.0, 40.0f64] {
            let cauchy = 0.5 - t.atan() / std::f64::consts::PI;
            assert!((student_tail(t, 1.0) - cauchy).abs() < 1e-13, "{t}");
            let two = 0.5 - t / (2.0 * (2.0 + t * t).sqrt());
            assert!((student_tail(t, 2.0) - two).abs() < 1e-13, "{t}");
        }
        assert!(student_tail(f64::NAN, 3.0).is_nan() && student_quantile(0.5, 0.0).is_nan());
        assert_eq!(student_tail(f64::INFINITY, 5.0), 0.0);
    }
}
