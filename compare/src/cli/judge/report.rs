//! `snell report DIR`: the report of a finished study, written again.

use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::{Error, report};
use std::path::PathBuf;

/// Write the report of a results folder again
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Folder that `snell study` wrote
    #[arg(default_value = "out")]
    dir: PathBuf,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let report = report::write(&args.dir)?;
    if output.json {
        output.object("snell.report/1", &report)?;
    } else {
        output.line(&format!("report: {}", report.html.display()))?;
    }
    Ok(Status::Done)
}
