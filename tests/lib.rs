//! Helpers shared by the test targets.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The folder of the whole project.
///
/// # Panics
/// Never: this package has a parent.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// What a command left behind.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Exit status.
    pub status: Option<i32>,
    /// Standard output.
    pub answer: String,
    /// Standard error.
    pub message: String,
}

/// Runs a program in a folder.
///
/// # Panics
/// If it cannot be started.
#[must_use]
pub fn run(command: &mut Command) -> Ran {
    let started = command.output();
    assert!(started.is_ok(), "{command:?} cannot be started: {started:?}");
    let Output { status, stdout, stderr } = started.unwrap_or_else(|_| unreachable!());
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Ran { status: status.code(), answer: text(stdout), message: text(stderr) }
}
