//! What the commands do: accept a baseline, check against it.

mod accept;
mod pairs;
mod scenes;

pub use accept::{Accepted, accept_pairs, accept_scenes};
pub use pairs::check_pairs;
pub use scenes::{SceneOptions, check_scenes};

use super::cell::judge::{Material, Raised};
use super::file::expectation::{Expectation, apply};
use super::file::margin::{Margins, Written};
use super::verdict::{Check, Outcome, Rule, decide, worst};
use super::{AdapterClass, GateError};
use std::path::PathBuf;

/// What a check came to.
pub struct Checked {
    /// The gate's file.
    pub gate: PathBuf,
    /// True for a list of pairs.
    pub of_pairs: bool,
    /// Arguments beside the gate and the cells that make the same check again.
    pub again: Vec<String>,
    /// Class of the adapter; none for files.
    pub adapter: Option<AdapterClass>,
    /// Its name and driver.
    pub device: String,
    /// One per question, cell after cell.
    pub checks: Vec<Check>,
    /// Names of the cells that were judged.
    pub judged: Vec<String>,
    /// What was not looked at, with the reason.
    pub left_out: Vec<String>,
    /// What people should know.
    pub notes: Vec<String>,
    /// The images of each cell that has some.
    pub material: Vec<Material>,
}

impl Checked {
    /// The worst outcome.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        worst(&self.checks)
    }

    /// Names of the cells that fail or cannot be told, in order.
    #[must_use]
    pub fn in_doubt(&self) -> Vec<&str> {
        let bad = |name: &&String| {
            self.checks.iter().any(|c| c.cell == **name && c.outcome >= Outcome::Inconclusive)
        };
        self.judged.iter().filter(bad).map(String::as_str).collect()
    }
}

/// All cells judged together, then the expectations.
fn conclude(
    raised: Vec<Raised>,
    rule: Rule,
    expected: &[Expectation],
    class: Option<AdapterClass>,
    judged: &[String],
) -> Vec<Check> {
    let (mut questions, mut checks) = (Vec::new(), Vec::new());
    for raised in raised {
        questions.extend(raised.questions);
        checks.extend(raised.checks);
    }
    let mut all = decide(&questions, rule);
    all.append(&mut checks);
    apply(&mut all, expected, class, judged);
    // Cell after cell, in the order of the gate.
    all.sort_by_key(|check| judged.iter().position(|name| *name == check.cell));
    all
}

fn margins(written: &Written, class: Option<AdapterClass>) -> Margins {
    Margins::of(written, class)
}

/// True for the cells that were asked for: all, or those whose name starts so.
fn wanted(name: &str, only: &[String]) -> bool {
    only.is_empty() || only.iter().any(|start| name.starts_with(start.as_str()))
}

/// Refuses a name that no cell has.
fn known(only: &[String], names: &[&str]) -> Result<(), GateError> {
    let lost = |start: &&String| !names.iter().any(|name| name.starts_with(start.as_str()));
    match only.iter().find(lost) {
        Some(lost) => Err(GateError::NoSuchCell { wanted: lost.clone(), known: names.join(", ") }),
        None => Ok(()),
    }
}
