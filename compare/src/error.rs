//! What can stop a command: where, what, and what to write instead.

use crate::image_pair::ImagePairError;
use std::path::{Path, PathBuf};

/// Why a command could not do what it was asked. Exit status 2.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file or folder that cannot be read or written.
    #[error("{}: {what}: {source}", path.display())]
    File {
        /// Which one.
        path: PathBuf,
        /// What was to be done with it.
        what: &'static str,
        /// The system's answer.
        source: std::io::Error,
    },
    /// Image files that cannot be compared.
    #[error(transparent)]
    ImagePair(#[from] ImagePairError),
    /// An image that no number can be made of.
    #[error("{}: {why}", path.display())]
    Image {
        /// Which one.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// Standard output is gone or full.
    #[error("the answer cannot be written to standard output: {0}")]
    Output(std::io::Error),
}

impl Error {
    /// Turns the system's answer into an error about a path, for `map_err`.
    pub(crate) fn file(path: &Path, what: &'static str) -> impl Fn(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::File { path: path.clone(), what, source }
    }
}
