//! What a results directory shows people: a page, a Markdown table, a
//! spreadsheet, pictures.

mod assemble;
mod folder;
pub mod number;
mod numbers;
mod page;
pub mod pictures;
pub mod plot;
mod runs;
mod scene_plots;
mod spreadsheet;
mod verdict;
pub mod viewer;

use crate::results::{ResultsError, read_rows, read_study};
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
    /// Contact sheets, plots and pictures.
    pub pictures: Vec<PathBuf>,
}

/// Makes `report.html`, `report.md`, `results.csv`, `plots/*.svg` and
/// `pictures/*.png` from `results.jsonl`, `study.json` and the images that it
/// names, all in `directory`.
///
/// # Errors
/// When the results or an image cannot be read or a file cannot be written.
pub fn write(directory: &Path) -> Result<Report, ReportError> {
    let rows = read_rows(directory)?;
    let study = read_study(directory)?;
    let page = assemble::assemble(directory, study, &rows)?;
    let report = Report {
        html: directory.join("report.html"),
        markdown: directory.join("report.md"),
        csv: directory.join("results.csv"),
        pictures: page.scenes.iter().flat_map(|scene| scene.files.clone()).collect(),
    };
    files::write(&report.csv, &spreadsheet::csv(&rows))?;
    files::write(&report.markdown, page::Markdown { page: &page }.render()?.as_bytes())?;
    files::write(&report.html, page.render()?.as_bytes())?;
    Ok(report)
}
