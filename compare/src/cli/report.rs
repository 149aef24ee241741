//! `snell report DIR`: the report of a finished study, written again.

use super::Status;
use super::output::Output;
use crate::{Error, report};
use std::path::PathBuf;

/// Write the report of a results folder again
#[derive(clap::Args, Debug)]
pub(super) struct Args {
    /// Folder that `snell study` wrote
    #[arg(default_value = "out")]
    dir: PathBuf,
}

pub(super) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let report = report::write(&args.dir)?;
    if output.json {
        output.object("snell.report/1", &report)?;
    } else {
        output.line(&format!("report: {}", report.html.display()))?;
    }
    Ok(Status::Done)
}
