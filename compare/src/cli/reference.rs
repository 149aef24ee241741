//! `snell reference SCENE -o FILE`: the exact image.

use super::output::Output;
use super::view::ViewArgs;
use super::{Status, scene};
use crate::Error;
use crate::progress::Progress;
use clap::ValueEnum;
use reference::{EnvironmentLookup, Estimator, Level, Request, Watch};

/// Trace the exact image of a scene on the CPU
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// Built-in name (see `snell scenes`) or scene file
    scene: String,
    #[command(flatten)]
    view: ViewArgs,
    /// How much light transport counts
    #[arg(long, value_enum, default_value_t = LevelName::R1)]
    level: LevelName,
    /// Weight, of 1 per camera ray, below which a branch of the tree is cut
    #[arg(long, value_name = "WEIGHT", default_value_t = 1e-4)]
    cut: f64,
    /// Look the environment up in its lat-long original, to agree with other renderers, and not in
    /// the cube that the GPU uses
    #[arg(long)]
    lat_long: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(super) enum LevelName {
    /// One chain of refractions, reflected only when totally reflected, no Fresnel weights
    R0,
    /// The full tree of refractions and reflections
    R1,
    /// The full tree and opaque surroundings
    R2,
}

impl From<LevelName> for Level {
    fn from(name: LevelName) -> Self {
        match name {
            LevelName::R0 => Self::R0,
            LevelName::R1 => Self::R1,
            LevelName::R2 => Self::R2,
        }
    }
}

pub(super) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let scene = scene(&args.scene)?;
    let request = Request {
        estimator: Estimator::Tree { cut: args.cut },
        environment_lookup: if args.lat_long {
            EnvironmentLookup::LatLong
        } else {
            EnvironmentLookup::Cube
        },
        ..Request::new(args.view.view(&scene), args.level.into())
    };
    let progress = Progress::new(&format!("tracing {}", scene.name));
    let watch = Watch { progress: Some(&|share| progress.at(share)), ..Watch::default() };
    let rendering = reference::render_watched(&scene, &request, watch)?;
    drop(progress);
    args.view.finish(&rendering, output)
}
