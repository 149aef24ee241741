//! GitHub Actions: annotations at the commit, a summary of the step.

use super::{command, junit, table};
use crate::gate::run::Checked;
use crate::gate::verdict::Outcome;

/// GitHub shows no more of one step.
pub const MOST_ANNOTATIONS: usize = 10;

/// Lines that GitHub turns into annotations: failures first, at most
/// [`MOST_ANNOTATIONS`]; the last one says how many more there are.
#[must_use]
pub fn annotations(checked: &Checked) -> Vec<String> {
    let mut bad: Vec<_> = checked.checks.iter().filter(|c| c.outcome > Outcome::Pass).collect();
    bad.sort_by_key(|check| std::cmp::Reverse(check.outcome));
    let line = |check: &&crate::gate::verdict::Check| {
        let kind = if check.outcome == Outcome::Fail { "error" } else { "warning" };
        let title = format!("{} {}: {}", check.cell, check.metric, check.outcome.word());
        let text = format!(
            "{}\n{}\n{}",
            check.reason,
            junit::numbers(check),
            command::reproduce(checked, &[&check.cell])
        );
        format!("::{kind} title={}::{}", escaped(&title, true), escaped(&text, false))
    };
    if bad.len() <= MOST_ANNOTATIONS {
        return bad.iter().map(line).collect();
    }
    let shown = MOST_ANNOTATIONS - 1;
    let more =
        format!("::error title=snell check::and {} more: see the summary", bad.len() - shown);
    bad[..shown].iter().map(line).chain([more]).collect()
}

/// Escapes as the runner undoes it (actions/toolkit, `command.ts`).
fn escaped(text: &str, in_title: bool) -> String {
    let text = text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    if in_title { text.replace(':', "%3A").replace(',', "%2C") } else { text }
}

/// Markdown for `$GITHUB_STEP_SUMMARY`.
#[must_use]
pub fn summary(checked: &Checked) -> String {
    let mut text = format!("### snell check: {}\n\n", table::summary(checked));
    let rows = table::rows(checked);
    for (i, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
        if i == 0 {
            text.push_str(&format!("|{}\n", "---|".repeat(row.len())));
        }
    }
    let in_doubt = checked.in_doubt();
    if !in_doubt.is_empty() {
        let again = command::reproduce(checked, &in_doubt);
        let accept = command::accept(checked, &in_doubt);
        text.push_str(&format!(
            "\nSee it again:\n\n```sh\n{again}\n```\n\nIf the change is meant:\n\n```sh\n{accept}\n```\n"
        ));
    }
    for note in checked.notes.iter().chain(&checked.left_out) {
        text.push_str(&format!("\n- {note}"));
    }
    text.push('\n');
    text
}
