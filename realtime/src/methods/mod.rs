//! The methods: what each is, where it was published, and what can be set.
//!
//! A method is one file of WGSL, whose head says what it is, and one row of the
//! registry with its parameters. Which passes and buffers it needs is not written
//! down anywhere: it is read from its WGSL.

mod declared;
mod layers;
mod registry;
mod settings;
mod user_file;

pub use layers::LAYERS;
pub use registry::METHODS;
pub use settings::{Settings, Value};

use crate::error::Error;
use crate::wgsl::{self, Head, Source};

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
    /// Meets the bodies by rays of its own: nothing is drawn for it.
    pub follows_rays: bool,
    /// Its WGSL.
    pub(crate) source: Source,
    from_user: bool,
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
        /// Only whole numbers make sense.
        whole: bool,
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

    /// Light bends at vertices and what comes of it is interpolated between them, or
    /// the way to the eye is: triangles show.
    #[must_use]
    pub fn bends_at_vertices(&self, settings: &Settings) -> bool {
        self.at_vertices(settings).is_some()
    }

    /// The image is another than that of nothing even where all indices are equal.
    #[must_use]
    pub fn bends_at_equal_index(&self, settings: &Settings) -> bool {
        self.heads(settings).any(|head| head.bends_at_equal_index)
    }

    /// The file of what it does at vertices.
    pub(crate) fn at_vertices(&self, settings: &Settings) -> Option<String> {
        self.heads(settings).find_map(|head| head.at_vertices)
    }

    /// Heads of its own file and of those that its parameters choose.
    fn heads(&self, settings: &Settings) -> impl Iterator<Item = Head> {
        let chosen: Vec<_> = settings.files().filter_map(|(_, file)| wgsl::named(&file)).collect();
        [self.source.head()].into_iter().chain(chosen.into_iter().map(|file| file.head()))
    }

    /// The WGSL of a user's method.
    #[must_use]
    pub fn file_text(&self) -> Option<&str> {
        self.from_user.then_some(&self.source.text)
    }

    /// A method of this crate, from the file that is called like it.
    fn built_in(id: &'static str, parameters: &'static [Parameter]) -> Self {
        let file = id.replace('-', "_");
        let source = wgsl::named(&file).unwrap_or_else(|| panic!("there is no file {file}.wgsl"));
        Self { parameters, ..Self::from_source(id, source) }
    }

    /// What the head of its file says.
    fn from_source(id: &'static str, source: Source) -> Self {
        let head = source.head();
        Self {
            id,
            alias: head.alias.leak(),
            title: head.title.leak(),
            about: head.about.leak(),
            bibtex: head.citation.leak(),
            parameters: &[],
            traces_colours: !head.one_way_for_all_colours,
            follows_rays: head.follows_rays,
            source,
            from_user: false,
        }
    }
}
