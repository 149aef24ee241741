//! Reading and writing the files of a results directory.

use super::{RESULT_SCHEMA, RESULTS_FILE, ResultRow, STUDY_FILE, STUDY_SCHEMA, Study};
use crate::support::files::{self, FileError};
use std::io::BufRead;
use std::path::{Path, PathBuf};

/// What can go wrong with a results directory.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A line is not a row, or the file is not a study.
    #[error("{path}:{line}: {source}; `snell study -o DIR` writes this file")]
    Json {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// Why.
        source: serde_json::Error,
    },
    /// The file is of another major version.
    #[error("{path}:{line}: schema `{found}`, but this snell reads `{expected}`")]
    Schema {
        /// The file.
        path: PathBuf,
        /// Line, counted from 1.
        line: usize,
        /// What the file says.
        found: String,
        /// What can be read.
        expected: &'static str,
    },
}

/// Reads all rows of a results directory.
///
/// # Errors
/// When the file is missing, a line is no row, or the schema is another one.
pub fn read_rows(directory: &Path) -> Result<Vec<ResultRow>, ResultsError> {
    let path = directory.join(RESULTS_FILE);
    let failed = FileError::of(&path, "cannot be read");
    let file = std::fs::File::open(&path).map_err(&failed)?;
    let mut rows = Vec::new();
    for (index, line) in std::io::BufReader::new(file).lines().enumerate() {
        let line = line.map_err(&failed)?;
        if line.trim().is_empty() {
            continue;
        }
        let row: ResultRow = serde_json::from_str(&line).map_err(|source| ResultsError::Json {
            path: path.clone(),
            line: index + 1,
            source,
        })?;
        check_schema(&path, index + 1, &row.schema, RESULT_SCHEMA)?;
        rows.push(row);
    }
    Ok(rows)
}

/// Writes all rows of a results directory, one JSON object per line.
///
/// # Errors
/// When the file cannot be written.
pub fn write_rows(directory: &Path, rows: &[ResultRow]) -> Result<(), ResultsError> {
    let mut text = Vec::new();
    for row in rows {
        text.extend(serde_json::to_vec(row).unwrap_or_default());
        text.push(b'\n');
    }
    Ok(files::write(&directory.join(RESULTS_FILE), &text)?)
}

/// Reads `study.json` of a results directory.
///
/// # Errors
/// When the file is missing, is no study, or the schema is another one.
pub fn read_study(directory: &Path) -> Result<Study, ResultsError> {
    let path = directory.join(STUDY_FILE);
    let text = std::fs::read_to_string(&path).map_err(FileError::of(&path, "cannot be read"))?;
    let study: Study = serde_json::from_str(&text).map_err(|source| ResultsError::Json {
        path: path.clone(),
        line: source.line(),
        source,
    })?;
    check_schema(&path, 1, &study.schema, STUDY_SCHEMA)?;
    Ok(study)
}

/// Writes `study.json` of a results directory.
///
/// # Errors
/// When the file cannot be written.
pub fn write_study(directory: &Path, study: &Study) -> Result<(), ResultsError> {
    let text = serde_json::to_vec_pretty(study).unwrap_or_default();
    Ok(files::write(&directory.join(STUDY_FILE), &text)?)
}

fn check_schema(
    path: &Path,
    line: usize,
    found: &str,
    expected: &'static str,
) -> Result<(), ResultsError> {
    if found == expected {
        return Ok(());
    }
    Err(ResultsError::Schema { path: path.to_owned(), line, found: found.to_owned(), expected })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;
    use crate::results::Validity;

    #[test]
    fn rows_survive_the_file_and_a_foreign_schema_does_not() {
        let directory = tempfile::tempdir().unwrap();
        let mut row = ResultRow {
            schema: RESULT_SCHEMA.to_owned(),
            metric: "relmse_e1e-2".to_owned(),
            value: Some(0.1 + 0.2),
            ..ResultRow::default()
        };
        let nothing = ResultRow { value: None, status: Validity::Invalid, ..row.clone() };
        write_rows(directory.path(), &[row.clone(), nothing.clone()]).unwrap();
        assert_eq!(read_rows(directory.path()).unwrap(), [row.clone(), nothing]);

        row.schema = "snell.result/9".to_owned();
        write_rows(directory.path(), &[row]).unwrap();
        let error = read_rows(directory.path()).unwrap_err().to_string();
        assert!(error.contains("results.jsonl:1: schema `snell.result/9`"), "{error}");
    }

    #[test]
    fn a_later_minor_version_may_add_fields() {
        let directory = tempfile::tempdir().unwrap();
        let text = r#"{"schema":"snell.study/1","version":"9","invented_later":1}"#;
        std::fs::write(directory.path().join(STUDY_FILE), text).unwrap();
        assert_eq!(read_study(directory.path()).unwrap().version, "9");
    }
}
