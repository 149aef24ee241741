//! The methods: what each is, where it was published, and what can be set.
//!
//! A method is one WGSL file and one row here. Which passes and buffers it
//! needs is not written down anywhere: it is read from its WGSL.

mod registry;
mod settings;
mod user_file;

pub use registry::METHODS;
pub use settings::{Settings, Value};

use crate::Error;
use crate::wgsl::Piece;

/// One approximation.
pub struct Method {
    /// Id in the CLI, TOML, JSON and data frames.
    pub id: &'static str,
    /// Short name in the literature of this project, such as `M2`.
    pub alias: &'static str,
    /// What it is, in a few words.
    pub title: &'static str,
    /// What it does and where it goes visibly wrong.
    pub about: &'static str,
    /// BibTeX entry of its source.
    pub bibtex: &'static str,
    /// What can be set.
    pub parameters: &'static [Parameter],
    /// Traces red and blue light on ways of their own where a medium disperses.
    pub traces_colours: bool,
    pub(crate) pieces: Pieces,
}

/// Where a method's WGSL comes from.
pub(crate) enum Pieces {
    /// From this crate.
    Built(fn(&Settings) -> Result<Vec<Piece>, Error>),
    /// From a user's file.
    Read(Piece),
}

/// Something that can be set.
#[derive(Debug, PartialEq)]
pub struct Parameter {
    /// Name in `--param name=value`.
    pub name: &'static str,
    /// Kind, default and range.
    pub kind: Kind,
    /// Unit; empty for pure numbers and words.
    pub unit: &'static str,
    /// One line for people.
    pub help: &'static str,
}

/// Kind of a parameter.
#[derive(Debug, PartialEq)]
pub enum Kind {
    /// A number in a closed range.
    Number {
        /// Used unless set.
        default: f64,
        /// Smallest.
        min: f64,
        /// Largest.
        max: f64,
    },
    /// One of some words; the first is the default.
    Choice(&'static [&'static str]),
}

impl Method {
    /// The method of that id or alias, or the one that a `.wgsl` file holds.
    ///
    /// # Errors
    /// If there is none.
    pub fn find(wanted: &str) -> Result<&'static Self, Error> {
        if wanted.ends_with(".wgsl") {
            return user_file::method(wanted);
        }
        let found = METHODS
            .iter()
            .find(|method| method.id == wanted || method.alias.eq_ignore_ascii_case(wanted))
            .or_else(|| user_file::known(wanted));
        found.ok_or_else(|| Error::UnknownMethod {
            wanted: wanted.to_owned(),
            available: METHODS.iter().map(|method| method.id).collect::<Vec<_>>().join(", "),
        })
    }

    /// The WGSL of a method from a file.
    #[must_use]
    pub fn file_text(&self) -> Option<&str> {
        match &self.pieces {
            Pieces::Built(_) => None,
            Pieces::Read(piece) => Some(&piece.text),
        }
    }

    pub(crate) fn pieces(&self, settings: &Settings) -> Result<Vec<Piece>, Error> {
        match &self.pieces {
            Pieces::Built(pieces) => pieces(settings),
            Pieces::Read(piece) => Ok(vec![piece.clone()]),
        }
    }
}
