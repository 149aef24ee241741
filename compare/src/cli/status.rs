//! How a command ends.

/// The end of every help.
pub(super) const EXIT_STATUS: &str =
    "Exit status: 0 done, 1 a gate failed, 2 could not run, 3 inconclusive.";

/// How a command ended, if it could run at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Status {
    /// It did what it was asked.
    Done = 0,
}
