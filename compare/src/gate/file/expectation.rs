//! Failures that are known and expected on one class of adapters, each with its
//! reason. One that does not come fails the gate too: then the line is out of
//! date, and hides the next failure.

use crate::gate::AdapterClass;
use crate::gate::verdict::{Check, Outcome};
use serde::Deserialize;

/// A failure that is expected.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Class of adapters; every class if it is left out.
    pub adapter: Option<AdapterClass>,
    /// Name of the cell.
    pub cell: String,
    /// Metric that fails.
    pub metric: String,
    /// Why, for people.
    pub reason: String,
}

impl Expectation {
    fn holds_on(&self, class: Option<AdapterClass>) -> bool {
        self.adapter.is_none() || self.adapter == class
    }
}

/// Turns expected failures into passes, and expected failures that did not come
/// into failures. `judged`: names of the cells that were looked at.
pub fn apply(
    checks: &mut Vec<Check>,
    expected: &[Expectation],
    class: Option<AdapterClass>,
    judged: &[String],
) {
    for expectation in expected.iter().filter(|e| e.holds_on(class) && judged.contains(&e.cell)) {
        let Expectation { cell, metric, reason, .. } = expectation;
        let found = checks.iter_mut().find(|c| c.cell == *cell && c.metric == *metric);
        match found {
            Some(check) if check.outcome == Outcome::Fail => {
                check.outcome = Outcome::Pass;
                check.reason = format!("expected to fail: {reason} ({})", check.reason);
            }
            Some(check) => {
                check.reason = format!(
                    "expected to fail ({reason}), but its outcome is {}: remove the expectation",
                    check.outcome.word()
                );
                check.outcome = Outcome::Fail;
            }
            None => checks.push(Check::plain(
                cell,
                metric,
                Outcome::Fail,
                format!("expected to fail ({reason}), but nothing of that name is checked"),
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checks(outcome: Outcome) -> Vec<Check> {
        vec![Check::plain("cup/multi", "flip", outcome, "worse".to_owned())]
    }

    fn expectation(adapter: Option<AdapterClass>, metric: &str) -> Expectation {
        let (cell, metric) = ("cup/multi".to_owned(), metric.to_owned());
        Expectation { adapter, cell, metric, reason: "depth differs".to_owned() }
    }

    fn after(outcome: Outcome, expected: Expectation, class: AdapterClass) -> Vec<Check> {
        let mut checks = checks(outcome);
        apply(&mut checks, &[expected], Some(class), &["cup/multi".to_owned()]);
        checks
    }

    #[test]
    fn an_expected_failure_passes_and_an_unexpected_pass_fails() {
        let hardware = || expectation(Some(AdapterClass::Hardware), "flip");
        let failed = after(Outcome::Fail, hardware(), AdapterClass::Hardware);
        assert_eq!(failed[0].outcome, Outcome::Pass);
        assert!(failed[0].reason.contains("depth differs"), "{failed:?}");
        let passed = after(Outcome::Pass, hardware(), AdapterClass::Hardware);
        assert_eq!(passed[0].outcome, Outcome::Fail);
        assert!(passed[0].reason.contains("remove the expectation"), "{passed:?}");
        // On another class nothing is expected.
        let elsewhere = after(Outcome::Fail, hardware(), AdapterClass::Lavapipe);
        assert_eq!(elsewhere[0].outcome, Outcome::Fail);
        let elsewhere = after(Outcome::Pass, hardware(), AdapterClass::Lavapipe);
        assert_eq!(elsewhere[0].outcome, Outcome::Pass);
    }

    #[test]
    fn what_is_not_checked_cannot_be_expected() {
        let found = after(Outcome::Pass, expectation(None, "flap"), AdapterClass::Lavapipe);
        assert_eq!(found.len(), 2);
        assert_eq!(found[1].outcome, Outcome::Fail);
        let mut left_out = checks(Outcome::Pass);
        apply(&mut left_out, &[expectation(None, "flip")], None, &[]);
        assert_eq!(left_out, checks(Outcome::Pass), "a cell that was not looked at");
    }
}
