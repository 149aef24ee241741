//! Arguments that both renderers share, and the image that comes of them.

use super::scene::frame_is_there;
use super::values::{image_path, is_png, resolution};
use crate::Error;
use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::report::pictures::Picture;
use crate::report::pictures::colour_map;
use crate::results::PARAM;
use crate::study::cache::Id;
use crate::support::files;
use crate::support::repeats::stretches;
use scenes::rendering::{Pass, Time};
use scenes::{LayerName, Layers, Rendering, Scene, View};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// What is rendered.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "View")]
pub(in crate::cli) struct ViewArgs {
    /// Layers to compute, separated by commas; `snell methods` lists those of each method
    /// [default: radiance]
    #[arg(long, value_delimiter = ',', value_name = "LAYER")]
    layers: Vec<String>,
    /// Width x height in pixels, such as 640x360 [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = resolution)]
    resolution: Option<[u32; 2]>,
    /// K: radiance is the mean over K x K positions in each pixel [default: 4]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..=64))]
    positions: Option<u32>,
    /// Frame of the scene's sequence; 0 is the still
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
}

/// Where the image goes.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "Image")]
pub(in crate::cli) struct ImageArgs {
    /// Image to write: .exr holds every layer, .png shows the radiance
    #[arg(short, long, value_name = "FILE", value_parser = image_path)]
    out: PathBuf,
    /// Exposure of a .png in stops [default: chosen from the image]
    #[arg(long, value_name = "STOPS", allow_negative_numbers = true)]
    exposure: Option<f64>,
}

/// What a rendering tells about itself.
#[derive(Serialize)]
struct Answer<'a> {
    image: &'a Path,
    resolution_px: [u32; 2],
    passes: &'a [scenes::rendering::Pass],
    counters: &'a std::collections::BTreeMap<String, u64>,
    provenance: &'a scenes::rendering::Provenance,
}

impl ViewArgs {
    /// The view that is asked for.
    pub(in crate::cli) fn view(&self, scene: &Scene) -> Result<View, Error> {
        frame_is_there(scene, self.frame)?;
        let mut layers: Vec<LayerName> =
            self.layers.iter().map(|name| LayerName::from(name.trim())).collect();
        if layers.is_empty() {
            layers.push(LayerName::Radiance);
        }
        Ok(View {
            resolution_px: self.resolution.unwrap_or(scene.camera.resolution_px),
            positions_per_axis: self.positions.unwrap_or(4),
            frame: self.frame,
            layers,
        })
    }

    /// True if the number of positions was written and not left to the default.
    pub(in crate::cli) fn positions_given(&self) -> bool {
        self.positions.is_some()
    }
}

impl ImageArgs {
    /// The view with what the image shows among its layers.
    ///
    /// # Errors
    /// If an exposure is given to an image that has none.
    pub(in crate::cli) fn shown(&self, mut view: View) -> Result<View, Error> {
        if self.exposure.is_some() && !is_png(&self.out) {
            return Err(Error::Usage(
                "--exposure is that of a .png; an .exr holds radiance as it is\nleave it out"
                    .to_owned(),
            ));
        }
        if is_png(&self.out) && !view.layers.contains(&LayerName::Radiance) {
            view.layers.insert(0, LayerName::Radiance);
        }
        Ok(view)
    }

    /// Writes the image; an .exr tells what it is.
    pub(in crate::cli) fn write(
        &self,
        rendering: &Rendering,
        scene: &str,
        id: &Id,
    ) -> Result<(), Error> {
        if is_png(&self.out) {
            return self.write_png(&rendering.layers);
        }
        files::make_folder_of(&self.out)?;
        let provenance = &rendering.provenance;
        let named = [("scene", scene), ("method", &provenance.renderer), ("id", id.as_str())];
        let named = named.map(|(name, value)| (name.to_owned(), value.to_owned()));
        let parameters = provenance.parameters.iter();
        let parameters = parameters.map(|(name, value)| (format!("{PARAM}{name}"), value.clone()));
        let attributes = parameters.chain(named).collect();
        Ok(scenes::image::write_exr_with(&self.out, &rendering.layers, &attributes)?)
    }

    /// Writes the image and answers with what the rendering tells.
    pub(in crate::cli) fn finish(
        &self,
        rendering: &Rendering,
        scene: &str,
        id: &Id,
        output: Output,
    ) -> Result<Status, Error> {
        self.write(rendering, scene, id)?;
        self.answer(rendering, output)
    }

    /// Answers with what the rendering tells, once its image is written.
    pub(in crate::cli) fn answer(
        &self,
        rendering: &Rendering,
        output: Output,
    ) -> Result<Status, Error> {
        let answer = Answer {
            image: &self.out,
            resolution_px: rendering.layers.resolution_px,
            passes: &rendering.passes,
            counters: &rendering.counters,
            provenance: &rendering.provenance,
        };
        if output.json {
            output.object("snell.rendering/1", &answer)?;
        } else {
            output.line(&text(&answer))?;
        }
        Ok(Status::Done)
    }

    /// The radiance as the report shows it.
    fn write_png(&self, layers: &Layers) -> Result<(), Error> {
        let radiance = layers.get(&LayerName::Radiance).map_or(&[][..], |layer| &layer.data);
        let ev = self.exposure.unwrap_or_else(|| colour_map::exposure(radiance));
        let size_px = layers.resolution_px.map(|side| side as usize);
        let png = Picture::of_radiance(radiance, size_px, ev).png();
        Ok(files::write(&self.out, &png)?)
    }
}

fn text(answer: &Answer) -> String {
    let Answer { image, resolution_px: [width, height], passes, counters, provenance } = answer;
    let mut lines = vec![format!(
        "{}: {width} x {height}, {} on {}",
        image.display(),
        provenance.renderer,
        provenance.adapter
    )];
    for (times, passes) in stretches(passes) {
        let indent = if times > 1 { "    " } else { "  " };
        lines.extend((times > 1).then(|| format!("  {times} times")));
        lines.extend(passes.iter().map(|pass| format!("{indent}{}", timed(pass))));
    }
    let counts: Vec<String> = counters.iter().map(|(name, n)| format!("{n} {name}")).collect();
    lines.push(format!("  {}", counts.join(", ")));
    lines.join("\n")
}

/// A pass and its times, if it was timed.
fn timed(pass: &Pass) -> String {
    let time = |t: &Time| format!("{:.2} ms {:?}", t.milliseconds, t.source).to_lowercase();
    let times: Vec<String> = pass.times.iter().map(time).collect();
    if times.is_empty() {
        pass.name.clone()
    } else {
        format!("{}: {}", pass.name, times.join(", "))
    }
}
