//! `snell reference SCENE -o FILE`: the exact image.

use super::progressive::exact_id;
use super::{caustics, progressive};
use crate::Error;
use crate::cli::arguments::exact::ExactArgs;
use crate::cli::arguments::progress::ProgressArgs;
use crate::cli::arguments::scene::SceneArgs;
use crate::cli::arguments::view::{ImageArgs, ViewArgs};
use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::support::progress::Progress;
use reference::{Level, Watch};
use std::sync::Arc;
use std::time::Instant;

/// Trace the exact image of a scene on the CPU
#[derive(clap::Args, Debug)]
#[command(after_long_help = layers())]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    #[command(flatten)]
    image: ImageArgs,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    exact: ExactArgs,
    /// Shade a receiver with a map of `snell caustics`, in place of direct light (level r2)
    #[arg(long, value_name = "RECEIVER=FILE.exr", help_heading = "Light transport")]
    caustics: Option<String>,
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
    /// Write a first image of one ray per pixel at once, then ever finer ones; stopping leaves the
    /// last
    #[arg(long)]
    progressive: bool,
    #[command(flatten)]
    progress: ProgressArgs,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let started = Instant::now();
    args.running.progress.choose();
    let scene = args.scene.load(output)?;
    let view = args.image.shown(args.view.view(&scene)?)?;
    let mut request = args.exact.request(view, args.view.positions_given())?;
    if let Some(text) = &args.caustics {
        if request.level != Level::R2 {
            let what = "--caustics shades opaque surfaces, which only --level r2 shows";
            return Err(Error::Usage(format!("{what}\nwrite --level r2")));
        }
        request.caustics = Some(Arc::new(caustics::read(&scene, text, request.view.frame)?));
    }
    args.running.within(|| {
        if args.running.progressive {
            let rendering = progressive::render(&scene, &request, &args.image, started)?;
            return args.image.answer(&rendering, output);
        }
        let progress = Progress::new(&format!("tracing {}", scene.name));
        let watch = Watch { progress: Some(&|share| progress.at(share)), ..Watch::default() };
        let rendering = reference::render_watched(&scene, &request, watch)?;
        drop(progress);
        args.image.finish(&rendering, &scene.name, &exact_id(&scene, &request), output)
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
    format!("Layers:\n{}\n\n{}", crate::cli::output::table(&rows), crate::cli::status::EXIT_STATUS)
}
