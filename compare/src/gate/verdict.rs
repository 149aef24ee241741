//! What is concluded: pass, fail, or that it cannot be told.
//!
//! A question fails where its difference is above its margin, so surely that in
//! the whole family of questions one false alarm comes only at the stated level.
//! It is inconclusive where its interval is wider than the margin: the answer to
//! that is a better truth, not a wider margin.

use crate::support::statistics::{Correction, Estimate, adjusted};
use serde::{Deserialize, Serialize};

/// Confidence of the intervals that are shown and held against the margin.
pub const CONFIDENCE: f64 = 0.95;

/// A metric of a cell, on both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Name of the cell.
    pub cell: String,
    /// Name of the metric.
    pub metric: String,
    /// Its value for base.
    pub base: f64,
    /// Its value for head.
    pub head: f64,
    /// Head less base; positive is worse.
    pub difference: Estimate,
    /// What head may be worse, in the unit of the metric.
    pub margin: f64,
}

/// How sure one has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Probability of any false alarm in the whole family.
    pub level: f64,
    /// How the family is accounted for.
    pub correction: Correction,
}

impl Default for Rule {
    fn default() -> Self {
        Self { level: 0.01, correction: Correction::Holm }
    }
}

/// What became of a question.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Not worse than allowed.
    Pass,
    /// Worse than allowed by its value, but not surely; the gate stays open.
    Warn,
    /// The interval is wider than the margin.
    Inconclusive,
    /// Worse than allowed, or not to be judged at all.
    Fail,
}

impl Outcome {
    /// The word in tables and files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Warn => "warn",
            Self::Inconclusive => "inconclusive",
            Self::Fail => "fail",
        }
    }
}

/// A question with its answer: one line of a gate's results.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Name of the cell.
    pub cell: String,
    /// Name of the metric, the counter, or what else is checked.
    pub metric: String,
    /// Value for base, where there is one.
    pub base: Option<f64>,
    /// Value for head, where there is one.
    pub head: Option<f64>,
    /// Head less base; positive is worse.
    pub difference: Option<f64>,
    /// Lower end of the 95 % interval of the difference.
    pub ci_lo: Option<f64>,
    /// Upper end.
    pub ci_hi: Option<f64>,
    /// What head may be worse.
    pub margin: Option<f64>,
    /// Probability of such a difference if head were worse by just the margin,
    /// raised for the number of questions.
    pub p: Option<f64>,
    /// What is concluded.
    pub outcome: Outcome,
    /// Why, where that is not plain from the numbers.
    pub reason: String,
}

impl Check {
    /// Something that is known without statistics.
    #[must_use]
    pub fn plain(cell: &str, metric: &str, outcome: Outcome, reason: String) -> Self {
        Self {
            cell: cell.to_owned(),
            metric: metric.to_owned(),
            base: None,
            head: None,
            difference: None,
            ci_lo: None,
            ci_hi: None,
            margin: None,
            p: None,
            outcome,
            reason,
        }
    }
}

/// Answers all questions of a gate.
#[must_use]
pub fn decide(questions: &[Question], rule: Rule) -> Vec<Check> {
    let p: Vec<f64> = questions.iter().map(|q| q.difference.p_above(q.margin)).collect();
    let p = adjusted(&p, rule.correction);
    questions.iter().zip(p).map(|(question, p)| answer(question, p, rule.level)).collect()
}

fn answer(question: &Question, p: f64, level: f64) -> Check {
    let Question { cell, metric, base, head, difference, margin } = question;
    let (low, high) = difference.interval(CONFIDENCE);
    let (outcome, reason) = if !difference.value.is_finite() || !low.is_finite() {
        (Outcome::Fail, "the difference is not a finite number".to_owned())
    } else if p < level {
        (Outcome::Fail, format!("worse by more than {margin:.3e}"))
    } else if high - low > *margin && high > low {
        let reason = format!(
            "the interval is {:.2e} wide and the margin {margin:.2e}: the truth needs more batches",
            high - low
        );
        (Outcome::Inconclusive, reason)
    } else if difference.value > *margin {
        (Outcome::Warn, format!("worse by more than {margin:.3e}, but not surely"))
    } else {
        (Outcome::Pass, String::new())
    };
    Check {
        base: Some(*base),
        head: Some(*head),
        difference: Some(difference.value),
        ci_lo: Some(low),
        ci_hi: Some(high),
        margin: Some(*margin),
        p: Some(p),
        ..Check::plain(cell, metric, outcome, reason)
    }
}

/// The worst outcome; `Pass` for none.
#[must_use]
pub fn worst(checks: &[Check]) -> Outcome {
    checks.iter().map(|check| check.outcome).max().unwrap_or(Outcome::Pass)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn question(value: f64, standard_error: f64, margin: f64) -> Question {
        let difference = Estimate::known(value, standard_error);
        let (cell, metric) = ("a/b".to_owned(), "relmse".to_owned());
        Question { cell, metric, base: 1.0, head: 1.0 + value, difference, margin }
    }

    fn outcome(value: f64, standard_error: f64, margin: f64) -> Outcome {
        decide(&[question(value, standard_error, margin)], Rule::default())[0].outcome
    }

    #[test]
    fn the_four_outcomes() {
        assert_eq!(outcome(0.0, 0.0, 0.02), Outcome::Pass);
        assert_eq!(outcome(0.05, 0.005, 0.02), Outcome::Fail);
        assert_eq!(outcome(0.025, 0.004, 0.02), Outcome::Warn);
        assert_eq!(outcome(0.0, 0.02, 0.02), Outcome::Inconclusive);
        // Better by any amount is not worse.
        assert_eq!(outcome(-0.5, 0.001, 0.02), Outcome::Pass);
        // No scatter and no margin: any worsening is one.
        assert_eq!(
            (outcome(0.0, 0.0, 0.0), outcome(1e-9, 0.0, 0.0)),
            (Outcome::Pass, Outcome::Fail)
        );
        assert_eq!(outcome(f64::NAN, 0.0, 0.02), Outcome::Fail);
        assert_eq!(outcome(0.0, f64::NAN, 0.02), Outcome::Fail);
    }

    /// p = 0.004 alone is beyond a level of 0.01; as one of ten it is not.
    #[test]
    fn a_family_asks_for_more() {
        let alone = question(2.65, 1.0, 0.0);
        assert_eq!(decide(std::slice::from_ref(&alone), Rule::default())[0].outcome, Outcome::Fail);
        let mut family = vec![question(-1.0, 1.0, 0.0); 9];
        family.push(alone);
        assert_ne!(decide(&family, Rule::default())[9].outcome, Outcome::Fail);
        let rule = Rule { correction: Correction::None, ..Rule::default() };
        assert_eq!(decide(&family, rule)[9].outcome, Outcome::Fail, "each by itself");
        family[9] = question(4.0, 1.0, 0.0);
        assert_eq!(decide(&family, Rule::default())[9].outcome, Outcome::Fail, "surely enough");
        assert_eq!(worst(&decide(&family, Rule::default())), Outcome::Fail);
        assert_eq!(worst(&[]), Outcome::Pass);
    }
}
