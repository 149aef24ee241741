//! `snell export SCENE --to FORMAT`: the same scene for another renderer.

use crate::Error;
use crate::cli::arguments::scene::{SceneArgs, frame_is_there};
use crate::cli::output::Output;
use crate::cli::status::Status;
use clap::ValueEnum;
use scenes::export::{self, Written};
use serde::Serialize;
use std::path::PathBuf;

/// Write a scene for another renderer: anyone's second opinion
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Form to write
    #[arg(long, value_enum, value_name = "FORMAT")]
    to: Format,
    /// Frame of the sequence: where what moves stands
    #[arg(long, default_value_t = 0, value_name = "N")]
    frame: u32,
    /// Folder to make; it must not exist yet
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(in crate::cli) enum Format {
    /// Mitsuba 3 XML
    Mitsuba,
    /// pbrt-v4
    Pbrt,
    /// glTF 2.0 with KHR ior, transmission, volume and dispersion
    Gltf,
}

/// The answer for programs.
#[derive(Serialize)]
struct Answer {
    /// Main file.
    file: PathBuf,
    /// What the form could only say nearly, and how near.
    notes: Vec<String>,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let format = match args.to {
        Format::Mitsuba => export::Format::Mitsuba,
        Format::Pbrt => export::Format::Pbrt,
        Format::Gltf => export::Format::Gltf,
    };
    let scene = args.scene.load(output)?;
    frame_is_there(&scene, args.frame)?;
    let Written { file, notes } = export::write(&scene.still(args.frame), format, &args.out)?;
    if output.json {
        output.object("snell.export/1", &Answer { file, notes })?;
    } else {
        notes.iter().for_each(|note| Output::note(note));
        output.line(&file.display().to_string())?;
    }
    Ok(Status::Done)
}
