//! JUnit XML: one suite per gate, one case per check.

use super::command;
use crate::gate::run::Checked;
use crate::gate::verdict::{Check, Outcome};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

/// The XML text.
///
/// # Errors
/// If it cannot be written, with the reason.
pub fn xml(checked: &Checked) -> Result<String, String> {
    let mut report = Report::new("snell check");
    let mut suite = TestSuite::new(checked.gate.display().to_string());
    suite.add_test_cases(checked.checks.iter().map(|check| case(checked, check)));
    for left_out in &checked.left_out {
        let (name, reason) = left_out.split_once(": ").unwrap_or((left_out, ""));
        let mut status = TestCaseStatus::skipped();
        status.set_message(reason);
        let mut case = TestCase::new("left out", status);
        case.set_classname(name);
        suite.add_test_case(case);
    }
    report.add_test_suite(suite);
    report.to_string().map_err(|error| error.to_string())
}

fn case(checked: &Checked, check: &Check) -> TestCase {
    let cells = [check.cell.as_str()];
    let status = match check.outcome {
        Outcome::Pass | Outcome::Warn => TestCaseStatus::success(),
        // JUnit knows no third answer; an error is not a failed assertion.
        Outcome::Inconclusive | Outcome::Fail => {
            let kind = match check.outcome {
                Outcome::Fail => NonSuccessKind::Failure,
                _ => NonSuccessKind::Error,
            };
            let mut status = TestCaseStatus::non_success(kind);
            status.set_message(check.reason.clone()).set_type(check.outcome.word());
            status.set_description(format!(
                "{}\nsee it again: {}\naccept it: {}",
                numbers(check),
                command::reproduce(checked, &cells),
                command::accept(checked, &cells)
            ));
            status
        }
    };
    let mut case = TestCase::new(check.metric.clone(), status);
    case.set_classname(check.cell.clone());
    if check.outcome == Outcome::Warn {
        case.set_system_out(format!("{} {}", check.reason, numbers(check)));
    }
    case
}

/// The numbers of a check on a line.
#[must_use]
pub fn numbers(check: &Check) -> String {
    let all = [
        ("base", check.base),
        ("head", check.head),
        ("difference", check.difference),
        ("from", check.ci_lo),
        ("to", check.ci_hi),
        ("margin", check.margin),
        ("p", check.p),
    ];
    let known = all.iter().filter_map(|(name, value)| Some(format!("{name} {:.6e}", (*value)?)));
    known.collect::<Vec<_>>().join(", ")
}
