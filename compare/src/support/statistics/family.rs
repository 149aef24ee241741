//! Many questions at once: p-values of a family, so that one false alarm in all
//! of it is as unlikely as it would be in one question.

use serde::{Deserialize, Serialize};

/// How p-values are raised for the number of questions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Correction {
    /// Holm's step-down method: holds for any dependence.
    /// Source: Holm, *Scandinavian Journal of Statistics* 6, 1979.
    #[default]
    Holm,
    /// Šidák's: 1 - (1 - p)^m, exact for independent questions.
    /// Source: Šidák, *J. Am. Stat. Assoc.* 62, 1967.
    Sidak,
    /// Each question by itself.
    None,
}

/// The p-values after correction, in the order given. A question whose value is
/// below the level is answered so at that level for the whole family.
#[must_use]
pub fn adjusted(p: &[f64], correction: Correction) -> Vec<f64> {
    match correction {
        Correction::None => p.to_vec(),
        Correction::Sidak => {
            let m = p.len() as f64;
            // 1 - (1 - p)^m without the cancellation for small p.
            p.iter().map(|p| -(m * (-p).ln_1p()).exp_m1()).collect()
        }
        Correction::Holm => holm(p),
    }
}

fn holm(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*a].total_cmp(&p[*b]));
    let mut adjusted = vec![1.0; p.len()];
    let mut largest = 0.0f64;
    for (rank, place) in order.into_iter().enumerate() {
        // Never below that of a smaller p-value.
        largest = largest.max(((p.len() - rank) as f64 * p[place]).min(1.0));
        adjusted[place] = largest;
    }
    adjusted
}

#[cfg(test)]
mod tests {
    use super::*;
    use scenes::noise::SplitMix64;

    /// Four p-values worked through by hand: 4 x 0.005, 3 x 0.01, 2 x 0.03, then
    /// 1 x 0.04, which may not be smaller than the one before.
    #[test]
    fn holm_steps_down() {
        let found = adjusted(&[0.01, 0.04, 0.03, 0.005], Correction::Holm);
        for (found, expected) in found.iter().zip([0.03, 0.06, 0.06, 0.02]) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
        assert_eq!(adjusted(&[0.9, 0.8], Correction::Holm), [1.0, 1.0]);
        assert!(adjusted(&[], Correction::Holm).is_empty());
    }

    #[test]
    fn sidak_keeps_small_values_precise() {
        let found = adjusted(&[1e-12, 0.5, 1.0], Correction::Sidak);
        assert!((found[0] / 3e-12 - 1.0).abs() < 1e-6, "{found:?}");
        assert!((found[1] - 0.875).abs() < 1e-15 && found[2] == 1.0, "{found:?}");
    }

    /// 1,000 families of 20 true questions: any false alarm in 5 of 100 of them.
    /// Without correction there is one in 64 of 100.
    #[test]
    fn a_family_alarms_as_rarely_as_one_question() {
        let mut random = SplitMix64(5);
        let mut alarms = [0; 3];
        for _ in 0..1_000 {
            let p: Vec<f64> = (0..20).map(|_| random.uniform()).collect();
            let all = [Correction::Holm, Correction::Sidak, Correction::None];
            for (count, correction) in alarms.iter_mut().zip(all) {
                *count += u32::from(adjusted(&p, correction).iter().any(|p| *p < 0.05));
            }
        }
        let [holm, sidak, none] = alarms;
        assert!((30..=70).contains(&holm) && (30..=70).contains(&sidak), "{alarms:?}");
        assert!((590..=690).contains(&none), "{alarms:?}");
    }
}
