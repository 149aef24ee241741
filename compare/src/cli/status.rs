//! How a command ends.

/// The end of the help of every command that does not write its own.
pub(super) const EXIT_STATUS: &str = "Exit status: 0 done, 2 could not run.";

/// How a command ended, if it could run at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Status {
    /// It did what it was asked.
    Done = 0,
    /// A limit is passed, or a method got worse.
    GateFailed = 1,
    /// Intervals are too wide to tell.
    Inconclusive = 3,
}
