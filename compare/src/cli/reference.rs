//! `snell reference SCENE -o FILE`: the exact image.

use super::exact::ExactArgs;
use super::output::Output;
use super::view::{ImageArgs, ViewArgs};
use super::{Status, scene};
use crate::Error;
use crate::progress::Progress;
use reference::Watch;

/// Trace the exact image of a scene on the CPU
#[derive(clap::Args, Debug)]
#[command(after_long_help = layers())]
pub(super) struct Args {
    /// Built-in name (see `snell scenes`), or a .toml, .gltf or .glb file
    scene: String,
    #[command(flatten)]
    image: ImageArgs,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    exact: ExactArgs,
    #[command(flatten)]
    running: RunningArgs,
}

/// How the work is done; the image does not depend on it.
#[derive(clap::Args, Debug)]
#[command(next_help_heading = "Running")]
struct RunningArgs {
    /// Threads [default: one per core]; the image is the same, bit by bit, for any number
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

pub(super) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let scene = scene(&args.scene)?;
    let view = args.image.shown(args.view.view(&scene));
    let request = args.exact.request(view, args.view.positions_given())?;
    args.running.within(|| {
        let progress = Progress::new(&format!("tracing {}", scene.name));
        let watch = Watch { progress: Some(&|share| progress.at(share)), ..Watch::default() };
        let rendering = reference::render_watched(&scene, &request, watch)?;
        drop(progress);
        args.image.finish(&rendering, output)
    })
}

impl RunningArgs {
    /// Does work on as many threads as were asked for.
    fn within<T: Send>(&self, work: impl FnOnce() -> Result<T, Error> + Send) -> Result<T, Error> {
        let Some(threads) = self.threads else { return work() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build();
        let pool = pool.map_err(|error| {
            Error::Usage(format!("{threads} threads cannot be started: {error}\nwrite fewer"))
        })?;
        pool.install(work)
    }
}

/// The layers there are, as the end of the help.
fn layers() -> String {
    let row = |(name, meaning): &(&str, &str)| vec![format!("  {name}"), (*meaning).to_owned()];
    let rows: Vec<Vec<String>> = reference::LAYERS.iter().map(row).collect();
    format!("Layers:\n{}\n\n{}", super::output::table(&rows), super::EXIT_STATUS)
}
