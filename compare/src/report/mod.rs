//! What a results directory shows people: a page, a Markdown table, a
//! spreadsheet, pictures.

mod assemble;
mod citations;
mod folder;
pub mod number;
mod numbers;
mod page;
pub mod pictures;
pub mod plot;
mod ranking;
mod runs;
mod scene_plots;
mod spreadsheet;
mod verdict;
pub mod viewer;

use crate::results::{NotDone, ResultsError, Study, read_rows, read_study};
use crate::support::files::{self, FileError};
use askama::Template;
use std::path::{Path, PathBuf};

/// Why a report could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The results cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// An image of the study cannot be read.
    #[error(transparent)]
    Image(#[from] scenes::image::Error),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A template failed: our mistake.
    #[error("the page cannot be made: {0}")]
    Template(#[from] askama::Error),
}

/// Files of a report.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Report {
    /// The page, one file that opens by double click.
    pub html: PathBuf,
    /// The verdict as Markdown.
    pub markdown: PathBuf,
    /// All numbers as a table.
    pub csv: PathBuf,
    /// One line per run, one column per metric.
    pub wide_csv: PathBuf,
    /// Contact sheets, plots and pictures.
    pub pictures: Vec<PathBuf>,
}

/// What may be chosen of a report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// True if nothing lies beside the page: of a large study it holds means of pixels.
    pub single_file: bool,
    /// What the viewer's data may take in the page before they are shrunk, bytes.
    pub data_in_page_bytes: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { single_file: false, data_in_page_bytes: 40e6 }
    }
}

/// Most places of a study that a page shows.
const MOST_SHOWN: usize = 8;

/// Of a study with many places, those whose images were kept.
fn shown(mut study: Study) -> Study {
    let count = study.scenes.len();
    if count > MOST_SHOWN {
        let has_image = |name: &str| {
            study.runs.iter().any(|run| run.scene == name && !run.image.as_os_str().is_empty())
        };
        let kept: Vec<bool> = study.scenes.iter().map(|entry| has_image(&entry.name)).collect();
        let mut kept = kept.into_iter();
        study.scenes.retain(|_| kept.next() == Some(true));
        study.left_out.push(NotDone {
            what: format!("{} of {count} places", count - study.scenes.len()),
            reason: "not shown on this page; wide.csv and results.csv have their numbers"
                .to_owned(),
        });
    }
    study
}

/// Makes `report.html`, `report.md`, `results.csv`, `wide.csv`, `plots/*.svg` and
/// `pictures/*.png` from `results.jsonl`, `study.json` and the images that it
/// names, all in `directory`; for a page that would become too large also `data/*.js`.
///
/// # Errors
/// When the results or an image cannot be read or a file cannot be written.
pub fn write(directory: &Path, options: Options) -> Result<Report, ReportError> {
    let rows = read_rows(directory)?;
    let study = read_study(directory)?;
    let page = assemble::assemble(directory, shown(study), &rows, options)?;
    let report = Report {
        html: directory.join("report.html"),
        markdown: directory.join("report.md"),
        csv: directory.join("results.csv"),
        wide_csv: directory.join("wide.csv"),
        pictures: page.scenes.iter().flat_map(|scene| scene.files.clone()).collect(),
    };
    files::write(&report.csv, &spreadsheet::csv(&rows))?;
    files::write(&report.wide_csv, &spreadsheet::wide(&rows))?;
    files::write(&report.markdown, page::Markdown { page: &page }.render()?.as_bytes())?;
    files::write(&report.html, page.render()?.as_bytes())?;
    Ok(report)
}
