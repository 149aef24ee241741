//! Which scene, and what takes the place of its own parts.

use crate::Error;
use crate::cli::output::Output;
use scenes::{Overrides, Scene};
use std::path::PathBuf;

const HEADING: &str = "In place of the scene's own";

/// The scene of a command that takes one.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct SceneArgs {
    /// Built-in name (see `snell scenes`), or a .toml, .gltf or .glb file
    scene: String,
    #[command(flatten)]
    in_place: OverrideArgs,
}

/// What takes the place of a scene's own.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct OverrideArgs {
    /// Environment: a lat-long image, linear, such as .exr or .hdr
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    pub(in crate::cli) map: Option<PathBuf>,
    /// Absolute refractive index of the scene's bodies, if all are of one medium
    #[arg(long, value_name = "INDEX", help_heading = HEADING)]
    pub(in crate::cli) eta: Option<f64>,
}

impl SceneArgs {
    /// The scene that is asked for. What is doubtful in it is told.
    pub(in crate::cli) fn load(&self, output: Output) -> Result<Scene, Error> {
        self.in_place.load(&self.scene, output)
    }

    /// The scene for a command in which no environment is seen.
    pub(in crate::cli) fn load_without_map(&self, output: Output) -> Result<Scene, Error> {
        if self.in_place.map.is_some() {
            return Err(Error::Usage(
                "--map changes nothing here: a caustic is the light of the scene's own lights\nleave \
                 it out"
                    .to_owned(),
            ));
        }
        self.load(output)
    }
}

impl OverrideArgs {
    /// True if there is anything to put in.
    pub(in crate::cli) fn is_some(&self) -> bool {
        self.map.is_some() || self.eta.is_some()
    }

    /// The scene of that name with these parts. What is doubtful in it is told.
    pub(in crate::cli) fn load(&self, name: &str, output: Output) -> Result<Scene, Error> {
        self.put_into(scenes::find(name)?, name, output)
    }

    /// The scene with these parts. What is doubtful in it is told.
    pub(in crate::cli) fn put_into(
        &self,
        mut scene: Scene,
        name: &str,
        output: Output,
    ) -> Result<Scene, Error> {
        Overrides { map: self.map.clone(), eta: self.eta }.apply(&mut scene)?;
        output.warn(name, &scene.warnings)?;
        Ok(scene)
    }
}

/// That the scene's sequence has a frame of that number.
pub(in crate::cli) fn frame_is_there(scene: &Scene, frame: u32) -> Result<(), Error> {
    let frames = scene.sequence.frames;
    if frame < frames {
        return Ok(());
    }
    let has = match frames {
        1 => "is a still: its only frame is 0".to_owned(),
        _ => format!("has the frames 0 to {}", frames - 1),
    };
    Err(Error::Usage(format!(
        "--frame {frame}: {} {has}\nwrite one of them, or more frames under [sequence] in its file",
        scene.name
    )))
}
