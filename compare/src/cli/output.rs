//! Standard output: text for people or, with `--json`, one object per line.
//! Everything else (progress, warnings, errors) goes to standard error.

use crate::Error;
use crate::cli::warnings::Warnings;
use schemars::JsonSchema;
use serde::Serialize;
use std::io::{self, Write};

/// Where a command's answer goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Output {
    /// True when the answer is for programs.
    pub(super) json: bool,
    /// What people must know of what they asked for.
    pub(super) warnings: &'static Warnings,
}

/// An object of the answer: the name and version of its form, what was warned of,
/// and the rest.
#[derive(Serialize, JsonSchema)]
pub(super) struct Line<'a, T> {
    schema: &'a str,
    warnings: Vec<String>,
    #[serde(flatten)]
    object: &'a T,
}

impl Output {
    /// Writes a line of text.
    pub(super) fn line(self, text: &str) -> Result<(), Error> {
        writeln!(io::stdout().lock(), "{text}").map_err(Error::Output)
    }

    /// Warns of what is said of a thing: a scene, a file.
    ///
    /// # Errors
    /// If warnings are denied.
    pub(super) fn warn(self, of: &str, texts: &[String]) -> Result<(), Error> {
        self.warnings.tell(texts.iter().map(|text| format!("{of}: {text}")))
    }

    /// Tells people something that is not the answer.
    pub(super) fn note(text: &str) {
        // Nobody listens if standard error is closed.
        let _ = writeln!(io::stderr().lock(), "{text}");
    }

    /// Writes one JSON object on a line of its own.
    pub(super) fn object(self, schema: &str, object: &impl Serialize) -> Result<(), Error> {
        self.own_object(&Line { schema, warnings: self.warnings.all(), object })
    }

    /// Writes one JSON object that names its schema itself.
    pub(super) fn own_object(self, object: &impl Serialize) -> Result<(), Error> {
        let line = serde_json::to_string(object).map_err(|error| Error::Output(error.into()))?;
        self.line(&line)
    }
}

/// Columns of text, each as wide as its widest cell; numbers to the right.
pub(super) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max()
    };
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(&widths) {
            let number = cell.starts_with(|c: char| c.is_ascii_digit() || c == '-');
            let gap = " ".repeat(width - cell.chars().count());
            let padded = if number { gap + cell } else { cell.clone() + &gap };
            line.push_str(&padded);
            line.push_str("  ");
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_and_numbers_stand_to_the_right() {
        let rows = [["name", "ms"], ["a", "1.25"], ["longer", "10.50"]];
        let rows = rows.map(|row| row.map(str::to_owned).to_vec());
        assert_eq!(table(&rows), "name    ms\na        1.25\nlonger  10.50");
    }
}
