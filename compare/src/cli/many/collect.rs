//! `snell collect`: the results of a store as a study.

use crate::Error;
use crate::cli::Status;
use crate::cli::judge::study::{answer, command_line};
use crate::cli::output::Output;
use crate::study::shelf::collect;
use std::path::PathBuf;

/// Gather the results of a store into the folder that `snell study` would have left behind
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Folder that `snell run` filled
    store: PathBuf,
    /// Folder for the report, the results and the images
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Go on without the results that are missing, and name them
    #[arg(long)]
    partial: bool,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let command = command_line(std::env::args());
    let (study, rows) = collect(&args.store, &args.out, args.partial, &command)?;
    answer(&study, &rows, &args.out, output)
}
