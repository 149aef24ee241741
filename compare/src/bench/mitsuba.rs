//! Mitsuba 3 at the same scenes: processor time to the same error. What is
//! done is in a script of its own, which Python runs, so that nobody else needs
//! Mitsuba.

use super::BenchError;
use crate::support::files::FileError;
use serde::{Deserialize, Serialize};
use std::ffi::{OsStr, OsString};
use std::path::Path;
use std::process::{Command, Stdio};

const SCRIPT: &str = include_str!("beside_mitsuba.py");
/// Pixels of the images, each side.
pub const MITSUBA_PX: u32 = 512;
/// How often everything is measured.
pub const MITSUBA_REPETITIONS: u32 = 3;

/// One scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BesideMitsuba {
    /// Name of the body and its normals.
    pub scene: String,
    /// Version.
    pub mitsuba: String,
    /// How Mitsuba was compiled.
    pub variant: String,
    /// Pixels of the images, each side.
    pub resolution_px: u32,
    /// How often everything was measured.
    pub repetitions: u32,
    /// Share of the pixels that are not compared: normals that snell replaced.
    pub left_out: f64,
    /// Mitsuba's mean less the truth's, in standard errors of Mitsuba's.
    pub mean_difference_in_se: f64,
    /// The same of the truth's mean.
    pub relative_mean_difference: f64,
    /// By samples per pixel.
    pub rows: Vec<ToError>,
}

/// Processor seconds to one error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ToError {
    /// Mitsuba's samples per pixel.
    pub samples: u32,
    /// Root mean square error that they reach.
    pub rmse: f64,
    /// Median time of Mitsuba.
    pub mitsuba_cpu_s: f64,
    /// Median time of snell to that error.
    pub snell_cpu_s: f64,
    /// Which way of snell's got there first.
    pub snell_by: String,
    /// snell's time of Mitsuba's: below 1 snell is faster.
    pub ratio: f64,
    /// Least of all repetitions.
    pub ratio_low: f64,
    /// Most of all repetitions.
    pub ratio_high: f64,
}

/// The Python that `PYTHON` names, or `python3`.
#[must_use]
pub fn python() -> OsString {
    std::env::var_os("PYTHON").filter(|name| !name.is_empty()).unwrap_or_else(|| "python3".into())
}

/// Measures every scene. Progress goes to stderr. `snell`: this program.
///
/// # Errors
/// Python or Mitsuba is not there, or something breaks off.
pub fn beside_mitsuba(python: &OsStr, snell: &Path) -> Result<Vec<BesideMitsuba>, BenchError> {
    let folder = tempfile::tempdir().map_err(FileError::unwritten(&std::env::temp_dir()))?;
    let script = folder.path().join("beside_mitsuba.py");
    std::fs::write(&script, SCRIPT).map_err(FileError::unwritten(&script))?;
    let mut command = Command::new(python);
    command.arg(&script).arg(snell).arg(folder.path());
    command.args([MITSUBA_PX, MITSUBA_REPETITIONS].map(|n| n.to_string()));
    let python = python.to_string_lossy().into_owned();
    let output = command
        .stdin(Stdio::null())
        .output()
        .map_err(|source| BenchError::Python { python: python.clone(), source })?;
    let text = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        let lines: Vec<&str> = said.lines().collect();
        let said = lines[lines.len().saturating_sub(4)..].join("\n");
        return Err(BenchError::Mitsuba { python, said });
    }
    rows(&text)
}

fn rows(text: &str) -> Result<Vec<BesideMitsuba>, BenchError> {
    let row = |line: &str| {
        serde_json::from_str(line).map_err(|error| BenchError::Other {
            program: "Mitsuba's side",
            why: format!("answers {line:?}: {error}"),
        })
    };
    text.lines().map(row).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]
    use super::*;

    #[test]
    fn answers_are_read_and_broken_ones_refused() {
        let line = "{\"schema\": \"s\", \"scene\": \"ball\", \"mitsuba\": \"3\", \"variant\": \"v\", \
             \"resolution_px\": 8, \"repetitions\": 1, \"left_out\": 0.0, \
             \"mean_difference_in_se\": 0.5, \"relative_mean_difference\": 1e-5, \"rows\": \
             [{\"samples\": 64, \"rmse\": 0.1, \"mitsuba_cpu_s\": 2.0, \"snell_cpu_s\": 0.5, \
             \"snell_by\": \"tree\", \"ratio\": 0.25, \"ratio_low\": 0.2, \"ratio_high\": 0.3}]}";
        let found = rows(&format!("{line}\n{line}\n")).unwrap();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].rows[0].samples, found[0].rows[0].ratio), (64, 0.25));
        assert!(rows(&line[..50]).is_err());
    }
}
