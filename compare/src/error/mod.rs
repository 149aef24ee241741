//! What can stop a command: where, what, and what to write instead.

mod gate;

pub use gate::GateError;

use crate::bench::BenchError;
use crate::image_pair::ImagePairError;
use crate::metric::JudgementError;
use crate::report::ReportError;
use crate::results::{NotDone, ResultsError};
use crate::support::files::FileError;
use std::path::PathBuf;

/// Why a command could not do what it was asked. Exit status 2.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file or folder that cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A scene that cannot be read.
    #[error(transparent)]
    Scene(#[from] scenes::Error),
    /// A transparent object without an inside.
    #[error(transparent)]
    Body(#[from] scenes::topology::NotABody),
    /// A scene that cannot be written for another renderer.
    #[error(transparent)]
    Export(#[from] scenes::export::ExportError),
    /// An image file that cannot be read or written.
    #[error(transparent)]
    ImageFile(#[from] scenes::image::Error),
    /// A scene that has no exact image.
    #[error(transparent)]
    Reference(#[from] reference::Error),
    /// A scene that a method cannot show, or a GPU that cannot be used.
    #[error(transparent)]
    Realtime(#[from] realtime::Error),
    /// Images that cannot be judged.
    #[error(transparent)]
    Judgement(#[from] JudgementError),
    /// A results folder that cannot be read or written.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// A report that cannot be made.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A study in which no method could show any scene.
    #[error("no method could show any of the scenes\n{}", reasons(.0))]
    NothingDone(Vec<NotDone>),
    /// A speed that cannot be measured.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// Image files that cannot be compared.
    #[error(transparent)]
    ImagePair(#[from] ImagePairError),
    /// A gate that cannot be run.
    #[error(transparent)]
    Gate(#[from] GateError),
    /// An image that no number can be made of.
    #[error("{}: {why}", path.display())]
    Image {
        /// Which one.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// Warnings that the user does not accept.
    #[error("--deny-warnings: there {} above\nmend what is warned of, or leave the option out", warned(*.0))]
    Warnings(usize),
    /// Options that contradict each other.
    #[error("{0}")]
    Usage(String),
    /// Standard output is gone or full.
    #[error("the answer cannot be written to standard output: {0}")]
    Output(std::io::Error),
}

fn warned(count: usize) -> String {
    if count == 1 { "is a warning".to_owned() } else { format!("are {count} warnings") }
}

fn reasons(left_out: &[NotDone]) -> String {
    let lines = left_out.iter().map(|NotDone { what, reason }| format!("{what}: {reason}"));
    lines.collect::<Vec<_>>().join("\n")
}
