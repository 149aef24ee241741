//! Why a speed cannot be measured.

use crate::support::files::FileError;

const ADVICE: &str = "on Debian or Ubuntu: apt-get install libembree-dev g++";

/// What is missing or failed.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// There is no such compiler.
    #[error(
        "Embree's side is compiled when it is needed, and the compiler \"{compiler}\" cannot be \
         started: {source}\n{ADVICE}"
    )]
    Compiler {
        /// What was to be run.
        compiler: String,
        /// The system's answer.
        source: std::io::Error,
    },
    /// The compiler does not find Embree, or something else.
    #[error("Embree's side cannot be compiled with \"{compiler}\"\n{ADVICE}\n{said}")]
    Compile {
        /// What was run.
        compiler: String,
        /// The first lines it wrote.
        said: String,
    },
    /// There is no such Python.
    #[error(
        "Mitsuba's side is a script, and \"{python}\" cannot be started: {source}\nwrite \
         PYTHON=path/to/python3, of an environment in which `pip install mitsuba numpy` was done"
    )]
    Python {
        /// What was to be run.
        python: String,
        /// The system's answer.
        source: std::io::Error,
    },
    /// Mitsuba's side failed.
    #[error("Mitsuba's side broke off in \"{python}\"\n{said}")]
    Mitsuba {
        /// What was run.
        python: String,
        /// The last lines it wrote.
        said: String,
    },
    /// The other program broke off.
    #[error("{program} {why}")]
    Other {
        /// Which one.
        program: &'static str,
        /// What happened.
        why: String,
    },
    /// A file between the two programs.
    #[error(transparent)]
    File(#[from] FileError),
    /// No threads.
    #[error("threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// Answers that should be equal are not: our mistake.
    #[error("{what} do not answer as {than} do; please report this")]
    Disagree {
        /// Which answers.
        what: String,
        /// The ones they should equal.
        than: String,
    },
    /// Only Linux tells a process how much memory it holds.
    #[error("/proc/self/status does not say {0}: memory can be measured on Linux only")]
    NoMemoryFigures(&'static str),
    /// A scene that the renderer refuses.
    #[error(transparent)]
    Reference(#[from] reference::Error),
}
