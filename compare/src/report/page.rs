//! What a report shows, ready for its templates: text and numbers, no logic.

use super::citations::MethodAbout;
use super::number;
use super::pictures::MethodPictures;
use crate::results::{NotDone, SceneEntry, Study};
use askama::Template;
use std::path::PathBuf;

/// One value in a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Cell {
    /// What is printed.
    pub(super) text: String,
    /// Half of its 95 % interval, as ` ± 0.2`; empty where none is known.
    pub(super) spread: String,
    /// Why there is no number, or the full precision; shown on hover.
    pub(super) note: String,
    /// True for the best of its scene.
    pub(super) best: bool,
    /// True for a value that must not be used.
    pub(super) invalid: bool,
}

/// One method in one scene.
#[derive(Clone, Debug, Default)]
pub(super) struct MethodView {
    /// Method id, with the parameters that tell two runs of one method apart.
    pub(super) name: String,
    /// Marker in plots, as SVG; the same method has the same in all scenes.
    pub(super) marker: String,
    /// One per column of the verdict table.
    pub(super) cells: Vec<Cell>,
    /// Time of a frame.
    pub(super) time: Cell,
    /// Memory of its buffers.
    pub(super) memory: String,
    /// Passes that ran, with their times, and how often in a row.
    pub(super) passes: Vec<(usize, Vec<(String, String)>)>,
    /// All of them.
    pub(super) passes_count: usize,
    /// What was left out, why, and the bytes it would have taken.
    pub(super) left_out: Vec<(String, String, String)>,
    /// How much shorter the frame is for it; empty if that was not measured.
    pub(super) saved_time: String,
    /// What the scene has and the method cannot show.
    pub(super) unsupported: Vec<(String, String)>,
    /// Every measured number: name, value, unit, pixels, note.
    pub(super) numbers: Vec<[String; 5]>,
    /// Metrics that the pair does not have.
    pub(super) metrics_left_out: Vec<NotDone>,
    /// Parameters, `name = value`.
    pub(super) parameters: Vec<String>,
    /// Pictures, where the image file exists.
    pub(super) pictures: Option<MethodPictures<Shown>>,
}

impl MethodView {
    /// What was left out, and how much shorter the frame is for it.
    pub(super) fn left_out_short(&self) -> String {
        let count = self.left_out.len();
        if self.saved_time.is_empty() {
            return count.to_string();
        }
        format!("{count}: {}", self.saved_time)
    }
}

/// A picture inside the page.
#[derive(Clone, Debug, Default)]
pub(super) struct Shown {
    /// Width and height, pixels.
    pub(super) size_px: [usize; 2],
    /// PNG as a `data:` address.
    pub(super) data_uri: String,
}

/// One scene.
#[derive(Clone, Debug, Default)]
pub(super) struct SceneView {
    /// Its entry in the study.
    pub(super) entry: SceneEntry,
    /// Number of the scene, for anchors.
    pub(super) index: usize,
    /// Exposure of its pictures, stops.
    pub(super) ev: f64,
    /// Exact picture.
    pub(super) reference: Option<Shown>,
    /// How the exact picture was made, `name = value`.
    pub(super) reference_facts: Vec<String>,
    /// Methods.
    pub(super) methods: Vec<MethodView>,
    /// Plots.
    pub(super) plots: Vec<PlotView>,
    /// HDR data of the viewer.
    pub(super) data: Option<SceneData>,
    /// Files of pictures and plots that were written.
    pub(super) files: Vec<PathBuf>,
}

/// A plot with what is said under it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct PlotView {
    /// What it shows, as part of a file name.
    pub(super) kind: &'static str,
    /// Caption.
    pub(super) caption: String,
    /// SVG.
    pub(super) svg: String,
}

/// HDR data of one scene for the viewer.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SceneData {
    /// Width and height of the image files, pixels.
    pub(super) file_px: [usize; 2],
    /// Image by image, the exact one first.
    pub(super) images: Vec<ImageData>,
}

impl SceneData {
    /// Names, without their prefix, and text of what there is.
    pub(super) fn blocks(&self, scene: usize) -> impl Iterator<Item = (String, &str)> {
        self.images.iter().enumerate().flat_map(move |(i, image)| {
            let kinds =
                [("radiance", &image.radiance), ("flip", &image.flip), ("angle", &image.angle)];
            kinds
                .into_iter()
                .filter(|(_, text)| !text.is_empty())
                .map(move |(kind, text)| (format!("{scene}-{i}-{kind}"), text.as_str()))
        })
    }
}

/// HDR data of one image, each a block of base64 text.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ImageData {
    /// Name.
    pub(super) name: String,
    /// Radiance, three channels.
    pub(super) radiance: String,
    /// FLIP, one channel; empty for the exact image.
    pub(super) flip: String,
    /// Exit-angle error in degrees, -1 where there is none.
    pub(super) angle: String,
}

/// A whole report.
#[derive(Clone, Debug, Default, Template)]
#[template(path = "report.html")]
pub(super) struct Page {
    /// The study.
    pub(super) study: Study,
    /// The verdict in sentences.
    pub(super) headline: Vec<String>,
    /// Heads of the verdict table's columns: name, unit, which way is better.
    pub(super) columns: Vec<(&'static str, &'static str, &'static str)>,
    /// The methods of the study.
    pub(super) methods: Vec<MethodAbout>,
    /// Scenes.
    pub(super) scenes: Vec<SceneView>,
    /// Name, formula, unit, range, direction and source of each metric.
    pub(super) metrics: Vec<[String; 6]>,
    /// Where the viewer finds its blocks, as JSON that is safe in HTML.
    pub(super) viewer_json: String,
    /// What was done to keep the page small; empty if nothing.
    pub(super) size_note: String,
}

/// The same as Markdown.
#[derive(Clone, Debug, Template)]
#[template(path = "report.md", escape = "none")]
pub(super) struct Markdown<'a> {
    /// What it shows.
    pub(super) page: &'a Page,
}

impl Page {
    /// The clock of the plots, in words.
    pub(super) fn clock(&self) -> &'static str {
        match self.study.time_metric.as_str() {
            "time_timestamp_ms" => "GPU timestamps",
            "time_cpu_ms" => "CPU time",
            _ if self.study.software => {
                "wall time of the processor, which draws what a GPU would (software adapter)"
            }
            _ => "wall time",
        }
    }

    /// Blocks of the viewer with their element ids.
    pub(super) fn blocks(&self) -> Vec<(String, &str)> {
        let all = self.scenes.iter().filter_map(|scene| Some((scene.index, scene.data.as_ref()?)));
        let named = all.flat_map(|(index, data)| data.blocks(index));
        named.map(|(name, text)| (format!("data-{name}"), text)).collect()
    }

    /// Style sheet of the page.
    pub(super) fn css(&self) -> &'static str {
        include_str!("../../templates/report.css")
    }

    /// The colours of exit-angle errors as a CSS gradient.
    pub(super) fn ramp_css(&self) -> String {
        let stops: Vec<String> = (0..=8)
            .map(|i| super::pictures::colour_map::ramp(f64::from(i) / 8.0))
            .map(|[r, g, b]| format!("rgb({r} {g} {b})"))
            .collect();
        format!("linear-gradient(90deg, {})", stops.join(", "))
    }

    /// Script of the viewer.
    pub(super) fn js(&self) -> &'static str {
        concat!(
            include_str!("../../templates/picture.js"),
            include_str!("../../templates/viewer.js")
        )
    }

    /// How long the study took.
    pub(super) fn elapsed(&self) -> String {
        number::duration(1000.0 * self.study.elapsed_s)
    }
}

/// Text in a cell of a Markdown table.
pub(super) fn markdown(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' | '\r' => safe.push(' '),
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '|' | '*' | '_' | '`' | '[' | ']' | '\\' => safe.extend(['\\', character]),
            _ => safe.push(character),
        }
    }
    safe
}

/// Filters of the templates.
#[allow(unreachable_pub, reason = "the macro makes a public type of each filter")]
mod filters {
    use std::fmt::Display;

    /// Text in a cell of a Markdown table.
    #[askama::filter_fn]
    pub(super) fn md(text: impl Display, _: &dyn askama::Values) -> askama::Result<String> {
        Ok(super::markdown(&text.to_string()))
    }
}
