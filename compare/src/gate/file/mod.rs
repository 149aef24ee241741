//! What a gate reads and keeps: the gate and the list of pairs that people
//! write, and the baseline that `snell baseline accept` writes.

pub mod baseline;
pub mod expectation;
mod glob;
pub mod half_image;
pub mod margin;
pub mod pairs;
pub mod scenes;

use super::GateError;
use std::path::Path;

/// Reads a file of TOML into its form; errors tell line, column and what would
/// be right.
pub(super) fn read_toml<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, GateError> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| GateError::file(path, format!("cannot be read: {error}")))?;
    toml::from_str(&text).map_err(|error| GateError::file(path, error))
}

/// A file's path, taken from the folder of the file that names it.
pub(super) fn beside(file: &Path, named: &Path) -> std::path::PathBuf {
    file.parent().map_or_else(|| named.to_owned(), |folder| folder.join(named))
}
