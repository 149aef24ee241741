//! Sums and order statistics that do not depend on the size of the image.

/// Sum with a running compensation (Neumaier 1974): the error is a few units
/// in the last place of the sum of magnitudes, however many terms there are.
#[must_use]
pub fn sum(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut total, mut lost) = (0.0f64, 0.0f64);
    for value in values {
        let next = total + value;
        lost += if total.abs() >= value.abs() {
            (total - next) + value
        } else {
            (value - next) + total
        };
        total = next;
    }
    // An infinite total has no meaningful compensation.
    if total.is_finite() { total + lost } else { total }
}

/// Arithmetic mean; NaN for nothing.
#[must_use]
pub fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    sum(values) / count
}

/// Quantile `q` in 0..=1 of ascending values, linear between order statistics
/// (Hyndman & Fan 1996, definition 7: the default of R and numpy).
/// `None` for nothing.
#[must_use]
pub fn quantile(ascending: &[f64], q: f64) -> Option<f64> {
    let last = ascending.len().checked_sub(1)?;
    let position = q.clamp(0.0, 1.0) * last as f64;
    let below = position.floor() as usize;
    let above = (below + 1).min(last);
    let share = position - below as f64;
    Some(ascending[below] + share * (ascending[above] - ascending[below]))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;

    #[test]
    fn a_small_term_survives_between_large_ones_that_cancel() {
        let terms = [1.0, 1e100, 1.0, -1e100];
        assert_eq!(sum(terms), 2.0);
        assert_eq!(terms.iter().sum::<f64>(), 0.0, "plain addition loses it");
    }

    #[test]
    fn quantiles_interpolate_and_nothing_has_none() {
        let values = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(quantile(&values, 0.5).unwrap(), 2.5);
        assert_eq!(quantile(&values, 0.0).unwrap(), 1.0);
        assert_eq!(quantile(&values, 1.0).unwrap(), 4.0);
        assert!(quantile(&[], 0.5).is_none());
    }
}
