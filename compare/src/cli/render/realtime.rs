//! `snell realtime SCENE --method M -o FILE`: one approximation.

use crate::Error;
use crate::cli::arguments::adapter::AdapterArg;
use crate::cli::arguments::scene::SceneArgs;
use crate::cli::arguments::values::parameter;
use crate::cli::arguments::view::{ImageArgs, ViewArgs};
use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::study::jobs::Approximation;
use realtime::{Filter, Keep, Request, Timing};

/// Render one approximation of a scene on the GPU
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Approximation (see `snell methods`), or FILE.wgsl with one of your own
    #[arg(short, long, value_name = "METHOD")]
    method: String,
    /// Parameter of the method, such as a=0.33; repeat for several
    #[arg(short, long = "param", value_name = "NAME=VALUE", value_parser = parameter)]
    parameters: Vec<(String, String)>,
    /// Time the method for this many seconds [default: not timed]
    #[arg(long, value_name = "SECONDS")]
    timing: Option<f64>,
    /// Filter the environment with the GPU's own sampler, as timed frames do, and not with the
    /// formula of the exact renderer
    #[arg(long)]
    hardware_filter: bool,
    /// Keep buffers, code and pixels that this scene does not need, to see what leaving them out
    /// saves
    #[arg(long)]
    keep_all: bool,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    image: ImageArgs,
    #[command(flatten)]
    adapter: AdapterArg,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let scene = args.scene.load(output)?;
    let request = Request {
        view: args.image.shown(args.view.view(&scene)?)?,
        method: args.method.clone(),
        parameters: args.parameters.iter().cloned().collect(),
        filter: if args.hardware_filter { Filter::Hardware } else { Filter::Manual },
        timing: args.timing.map(|seconds| Timing { seconds, ..Timing::default() }),
        keep: if args.keep_all { Keep::Everything } else { Keep::Needed },
    };
    let gpu = args.adapter.open()?;
    let asked = Approximation { scene: &scene, request };
    let rendering = realtime::render(&gpu, &scene, &asked.request)?;
    args.image.finish(&rendering, &scene.name, &asked.id(&gpu), output)
}
