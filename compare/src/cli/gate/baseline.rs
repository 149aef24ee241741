//! `snell baseline accept`: what is now becomes what is expected.

use crate::Error;
use crate::cli::arguments::adapter::AdapterArg;
use crate::cli::arguments::cache::store;
use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::gate::file::pairs::PairGate;
use crate::gate::file::scenes::SceneGate;
use crate::gate::run::{Accepted, accept_pairs, accept_scenes};
use crate::support::progress::Progress;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Keep the images of now as the baseline that `snell check` holds later ones to
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, clap::Subcommand)]
enum Command {
    /// Render every cell of a gate, or read every pair, and write the baseline
    Accept(Accept),
}

#[derive(clap::Args, Debug)]
struct Accept {
    /// The gate: which methods are watched on which scenes
    #[arg(default_value = "gate.toml", value_name = "GATE.toml")]
    gate: PathBuf,
    /// A list of image pairs instead of a gate over scenes
    #[arg(long, value_name = "PAIRS.toml", conflicts_with = "gate")]
    pairs: Option<PathBuf>,
    /// Accept only cells whose names start so, and leave the others as they are; repeat for several
    #[arg(long, value_name = "CELL")]
    only: Vec<String>,
    /// Folder of exact images that were traced before [default: as `snell study`]
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArg,
}

/// The answer.
#[derive(Serialize)]
struct Answer<'a> {
    baseline: &'a Path,
    bytes: usize,
    accepted: &'a [String],
    cells: usize,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let Command::Accept(args) = &args.command;
    let accepted = match &args.pairs {
        Some(pairs) => accept_pairs(&PairGate::read(pairs)?, &args.only)?,
        None => {
            let gate = SceneGate::read(&args.gate)?;
            let gpu = args.adapter.open()?;
            let store = store(args.cache.as_deref(), output)?;
            let progress = Progress::new("");
            accept_scenes(&gate, &args.only, &gpu, &store, &|cell| progress.now(cell))?
        }
    };
    let Accepted { path, bytes, cells, total } = &accepted;
    if output.json {
        let answer = Answer { baseline: path, bytes: *bytes, accepted: cells, cells: *total };
        output.object("snell.accepted/1", &answer)?;
    } else {
        for cell in cells {
            output.line(&format!("accepted {cell}"))?;
        }
        let shown = path.display();
        output.line(&format!("{shown}: {total} cells, {:.2} MB", *bytes as f64 / 1e6))?;
    }
    Ok(Status::Done)
}
