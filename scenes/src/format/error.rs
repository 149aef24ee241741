//! What can be wrong with a scene, where, and what to write instead.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

/// Why there is no scene.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Something in a scene file is wrong.
    #[error("{}:{}:{}: {problem}\n{place}", place.file, place.line, place.column)]
    Invalid {
        /// Where.
        place: Box<Place>,
        /// What, and what to write instead.
        problem: Box<Problem>,
    },
    /// A scene file cannot be read.
    #[error(
        "cannot read the scene {}: {source}\nname a .toml, .gltf or .glb file or a built-in scene (`snell scenes` lists them)",
        path.display()
    )]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// No built-in scene and no file has that name.
    #[error(
        "no built-in scene is called \"{name}\" and there is no such file\nwrite one of {known}, or the path of a .toml, .gltf or .glb file"
    )]
    UnknownScene {
        /// What was asked for.
        name: String,
        /// Names that exist.
        known: String,
    },
    /// A built-in scene needs a file that this machine has not fetched.
    #[error(
        "the scene \"{scene}\" needs {}, which is not there\nfetch it with `make setup`, or name the folder that holds it in SNELL_ASSETS",
        path.display()
    )]
    MissingAsset {
        /// Built-in scene.
        scene: String,
        /// File that was looked for.
        path: PathBuf,
    },
    /// A number that cannot be set from outside.
    #[error("{scene}: {key} cannot be set: {why}")]
    Setting {
        /// Scene.
        scene: String,
        /// Path to the number.
        key: String,
        /// Why not, and what can be.
        why: String,
    },
    /// A mesh file given on its own is wrong.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A glTF file cannot be shown.
    #[error(transparent)]
    Gltf(#[from] crate::import::error::ImportError),
    /// An image file given on its own is wrong.
    #[error(transparent)]
    Image(#[from] crate::image::Error),
    /// A part that a scene has no place for.
    #[error("{0}")]
    Override(String),
    /// An index given on its own is wrong.
    #[error(transparent)]
    Eta(#[from] crate::eta::EtaError),
    /// A body given on its own cannot be shown.
    #[error("{}: {reason}", path.display())]
    Body {
        /// Mesh file.
        path: PathBuf,
        /// What is wrong with it and what would be right.
        reason: String,
    },
}

/// Why a mesh could not be read.
pub type MeshError = crate::obj::ObjError;

/// What is wrong with a part of a scene file.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// Not TOML, an unknown key, a missing key, or a value out of its range.
    #[error("{0}")]
    Value(String),
    /// Values that make no sense together.
    #[error("{what}\n{instead}")]
    Meaning {
        /// What does not fit.
        what: String,
        /// What to write instead.
        instead: String,
    },
    /// A mesh it refers to.
    #[error(transparent)]
    Mesh(MeshError),
    /// An image it refers to.
    #[error(transparent)]
    Image(crate::image::Error),
}

/// A place in a scene file; displays the line with the place marked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// File, or `built-in NAME`.
    pub file: String,
    /// From 1.
    pub line: usize,
    /// Characters, from 1.
    pub column: usize,
    /// Marked characters, at least 1.
    pub width: usize,
    /// The line's text.
    pub text: String,
}

impl Place {
    /// The place of a byte range in a text.
    pub(super) fn new(file: &str, text: &str, span: &Range<usize>) -> Self {
        let start = floor_boundary(text, span.start);
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |length| start + length);
        let end = floor_boundary(text, span.end).clamp(start, line_end);
        Self {
            file: file.to_owned(),
            line: text[..start].matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            width: text[start..end].chars().count().max(1),
            text: text[line_start..line_end].trim_end().to_owned(),
        }
    }
}

fn floor_boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A line that runs on is shown around its mark only.
        let skip = self.column.saturating_sub(60);
        let shown: String = self.text.chars().skip(skip).take(110).collect();
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        let indent = " ".repeat(self.column - 1 - skip);
        let marks = "^".repeat(self.width.min(110));
        write!(f, "{margin} |\n{number} | {shown}\n{margin} | {indent}{marks}")
    }
}

/// A problem and the bytes that cause it.
#[derive(Debug)]
pub(super) struct At {
    pub(super) span: Range<usize>,
    pub(super) problem: Problem,
}

impl At {
    /// Values that make no sense together.
    pub(super) fn meaning(
        span: Range<usize>,
        what: impl Into<String>,
        instead: impl Into<String>,
    ) -> Self {
        Self { span, problem: Problem::Meaning { what: what.into(), instead: instead.into() } }
    }

    /// The problem with its place.
    pub(super) fn within(self, file: &str, text: &str) -> Error {
        let place = Box::new(Place::new(file, text, &self.span));
        Error::Invalid { place, problem: Box::new(self.problem) }
    }
}

impl From<toml::de::Error> for At {
    fn from(error: toml::de::Error) -> Self {
        let message = error.message();
        // serde says what is missing or superfluous; say what to do about it.
        let advice = if message.starts_with("missing field") {
            "\nadd it to this table"
        } else if message.starts_with("duplicate") {
            "\nwrite it once"
        } else if message.starts_with("unknown field") {
            "\ncorrect the spelling or take it out"
        } else {
            ""
        };
        let problem = Problem::Value(format!("{}{advice}", message.trim_end()));
        Self { span: error.span().unwrap_or(0..0), problem }
    }
}
