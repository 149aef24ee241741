//! Commands that people can type: to see a failure again, to accept it.

use crate::gate::run::Checked;

/// The arguments of a command about some cells.
fn arguments(checked: &Checked, cells: &[&str]) -> String {
    let gate = quoted(&checked.gate.display().to_string());
    let pairs = if checked.of_pairs { "--pairs " } else { "" };
    let only: Vec<String> = cells.iter().map(|cell| format!(" --only {}", quoted(cell))).collect();
    format!("{pairs}{gate}{}", only.concat())
}

/// The command that judges these cells again.
#[must_use]
pub fn reproduce(checked: &Checked, cells: &[&str]) -> String {
    let more: Vec<String> = checked.again.iter().map(|word| format!(" {}", quoted(word))).collect();
    format!("snell check {}{}", arguments(checked, cells), more.concat())
}

/// The command that takes these cells as they are now for the baseline.
#[must_use]
pub fn accept(checked: &Checked, cells: &[&str]) -> String {
    format!("snell baseline accept {}", arguments(checked, cells))
}

/// A word as a shell reads it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', "'\\''")),
    }
}
