//! Why a gate cannot be run at all.

use std::path::{Path, PathBuf};

/// What is wrong with a gate's own files. Exit status 2: nothing was judged.
#[derive(Debug, thiserror::Error)]
pub enum GateError {
    /// A gate or list of pairs that cannot be read.
    #[error("{}: {reason}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong and what to write instead.
        reason: String,
    },
    /// No baseline yet.
    #[error("{}: there is no baseline\nlook at the images, then accept them: {accept}", path.display())]
    NoBaseline {
        /// Where it would be.
        path: PathBuf,
        /// The command that makes it.
        accept: String,
    },
    /// A name that no cell has.
    #[error("no cell is called \"{wanted}\"; there are: {known}")]
    NoSuchCell {
        /// As given.
        wanted: String,
        /// All names.
        known: String,
    },
    /// An image that cannot be a baseline.
    #[error("{cell}: {reason}")]
    Cell {
        /// Name of the cell.
        cell: String,
        /// Why.
        reason: String,
    },
    /// The program of another commit cannot be made or run.
    #[error("{program}: {reason}")]
    Program {
        /// What was run.
        program: String,
        /// What it said.
        reason: String,
    },
}

impl GateError {
    pub(crate) fn file(path: &Path, reason: impl ToString) -> Self {
        Self::File { path: path.to_owned(), reason: reason.to_string() }
    }
}
