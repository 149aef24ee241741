//! What a results directory shows people: a page, a Markdown table, a
//! spreadsheet, pictures.

mod assemble;
pub mod block;
pub mod colour_map;
pub mod number;
mod numbers;
mod page;
pub mod picture;
pub mod plot;
mod scene_images;
mod scene_plots;
mod verdict;
mod viewer;

use crate::image_pair::ImagePairError;
use crate::results::{ResultRow, ResultsError, read_rows, read_study};
use askama::Template;
use scene_images::SceneImages;
use std::path::{Path, PathBuf};

/// Why a report could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The results cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// An image of the study cannot be read.
    #[error(transparent)]
    Image(#[from] ImagePairError),
    /// A file cannot be written.
    #[error("{}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A template failed: our mistake.
    #[error("the page cannot be made: {0}")]
    Template(#[from] askama::Error),
}

/// Files of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
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
    let (page, images) = assemble::assemble(directory, study, &rows)?;
    let mut report = Report {
        html: directory.join("report.html"),
        markdown: directory.join("report.md"),
        csv: directory.join("results.csv"),
        pictures: Vec::new(),
    };
    write_file(&report.csv, &csv(&rows))?;
    write_file(&report.markdown, page::Markdown { page: &page }.render()?.as_bytes())?;
    for (scene, images) in page.scenes.iter().zip(&images) {
        let name = file_name(&scene.entry.name);
        for (number, (_, svg)) in scene.plots.iter().enumerate() {
            let kind = ["image", "exit-angle"].get(number).copied().unwrap_or("plot");
            let path = directory.join("plots").join(format!("{name}-{kind}.svg"));
            report.pictures.push(path.clone());
            write_file(&path, svg.as_bytes())?;
        }
        let names: Vec<&str> = scene.methods.iter().map(|m| m.name.as_str()).collect();
        for (path, picture) in pictures(images, &name, &names) {
            let path = directory.join("pictures").join(path);
            report.pictures.push(path.clone());
            write_file(&path, &picture.png())?;
        }
    }
    write_file(&report.html, page.render()?.as_bytes())?;
    Ok(report)
}

/// Full-size pictures of a scene and their contact sheet: one row per method,
/// exact | approximate | FLIP | exit angle.
fn pictures(
    images: &SceneImages,
    scene: &str,
    methods: &[&str],
) -> Vec<(String, picture::Picture)> {
    let Some(exact) = images.full_reference() else { return Vec::new() };
    let all: Vec<_> = images
        .methods
        .iter()
        .map(|image| image.as_ref().map(|image| image.full_pictures(images.ev)))
        .collect();
    let rows: Vec<Vec<Option<&picture::Picture>>> = all
        .iter()
        .flatten()
        .map(|p| vec![Some(&exact), Some(&p.image), p.flip.as_ref(), p.angle.as_ref()])
        .collect();
    let sheet = picture::contact_sheet(&rows);
    let mut list: Vec<(String, picture::Picture)> = Vec::new();
    list.extend(sheet.map(|sheet| (format!("{scene}.png"), sheet)));
    for (method, pictures) in methods.iter().zip(all) {
        let Some(pictures) = pictures else { continue };
        let method = file_name(method);
        list.push((format!("{scene}-{method}.png"), pictures.image));
        list.extend(pictures.flip.map(|p| (format!("{scene}-{method}-flip.png"), p)));
        list.extend(pictures.angle.map(|p| (format!("{scene}-{method}-angle.png"), p)));
    }
    list.push((format!("{scene}-exact.png"), exact));
    list
}

/// A name that is safe as a file name everywhere.
fn file_name(name: &str) -> String {
    let safe = |c: char| if c.is_ascii_alphanumeric() || "-_.=".contains(c) { c } else { '_' };
    name.chars().map(safe).collect::<String>().trim_start_matches('.').to_owned()
}

/// All rows as comma-separated values, parameters as `name=value` words.
fn csv(rows: &[ResultRow]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing into memory does not fail.
    let _ = writer.write_record([
        "schema",
        "kind",
        "id",
        "scene",
        "method",
        "parameters",
        "frame",
        "width_px",
        "height_px",
        "seed",
        "adapter",
        "software",
        "reference_id",
        "metric",
        "unit",
        "mask",
        "value",
        "ci_lo",
        "ci_hi",
        "n",
        "status",
        "reason",
    ]);
    let number = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let word = |value: serde_json::Value| value.as_str().unwrap_or_default().to_owned();
    for row in rows {
        let parameters: Vec<String> =
            row.parameters.iter().map(|(name, value)| format!("{name}={value}")).collect();
        let _ = writer.write_record([
            row.schema.clone(),
            word(serde_json::json!(row.kind)),
            row.id.clone(),
            row.scene.clone(),
            row.method.clone(),
            parameters.join(" "),
            row.frame.to_string(),
            row.width_px.to_string(),
            row.height_px.to_string(),
            row.seed.map(|seed| seed.to_string()).unwrap_or_default(),
            row.adapter.clone(),
            row.software.to_string(),
            row.reference_id.clone(),
            row.metric.clone(),
            row.unit.clone(),
            word(serde_json::json!(row.mask)),
            number(row.value),
            number(row.ci_lo),
            number(row.ci_hi),
            row.n.to_string(),
            word(serde_json::json!(row.status)),
            row.reason.clone(),
        ]);
    }
    writer.into_inner().unwrap_or_default()
}

fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    let io = |source| ReportError::Write { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(io)?;
    }
    let neighbour = path.with_extension(format!("{}.tmp", std::process::id()));
    std::fs::write(&neighbour, bytes).map_err(io)?;
    std::fs::rename(&neighbour, path).map_err(io)
}
