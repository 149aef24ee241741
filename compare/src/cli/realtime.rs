//! `snell realtime SCENE --method M -o FILE`: one approximation.

use super::adapter::AdapterArg;
use super::output::Output;
use super::view::{ImageArgs, ViewArgs};
use super::{Status, scene};
use crate::Error;
use realtime::{Filter, Request, Timing};

/// Render one approximation of a scene on the GPU
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// Built-in name (see `snell scenes`) or scene file
    scene: String,
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

pub(super) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let scene = scene(&args.scene)?;
    let request = Request {
        view: args.image.shown(args.view.view(&scene)),
        method: args.method.clone(),
        parameters: args.parameters.iter().cloned().collect(),
        filter: if args.hardware_filter { Filter::Hardware } else { Filter::Manual },
        timing: args.timing.map(|seconds| Timing { seconds, ..Timing::default() }),
        elide: !args.keep_all,
    };
    let gpu = args.adapter.open()?;
    let rendering = realtime::render(&gpu, &scene, &request)?;
    args.image.finish(&rendering, output)
}

/// Reads `NAME=VALUE`.
pub(super) fn parameter(text: &str) -> Result<(String, String), String> {
    let parts = text.split_once('=').map(|(name, value)| (name.trim(), value.trim()));
    match parts {
        Some((name, value)) if !name.is_empty() && !value.is_empty() => {
            Ok((name.to_owned(), value.to_owned()))
        }
        _ => Err("write NAME=VALUE, such as a=0.33".to_owned()),
    }
}
