//! `snell report DIR`: the report of a finished study, written again.

use crate::cli::arguments::external::ExternalArgs;
use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::study::added;
use crate::{Error, report};
use std::path::PathBuf;

/// Write the report of a results folder again, with images of others added to it if any are named
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Folder that `snell study` wrote
    #[arg(default_value = "out")]
    dir: PathBuf,
    /// Write the page alone, without data/ beside it: of a large study it then shows means of
    /// pixels, and says so
    #[arg(long)]
    single_file: bool,
    #[command(flatten)]
    externals: ExternalArgs,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    if !args.externals.is_empty() {
        added::add(&args.dir, &args.externals.list()?)?;
    }
    let options = report::Options { single_file: args.single_file, ..report::Options::default() };
    let report = report::write(&args.dir, options)?;
    if output.json {
        output.object("snell.report/1", &report)?;
    } else {
        output.line(&format!("report: {}", report.html.display()))?;
    }
    Ok(Status::Done)
}
