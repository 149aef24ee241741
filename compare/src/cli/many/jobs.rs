//! `snell jobs`: what a study comes to, one job a line.

use crate::Error;
use crate::cli::Status;
use crate::cli::arguments::study::StudyArgs;
use crate::cli::output::Output;
use crate::study::sweep::{check, expand};

/// List the jobs of a study, one JSON object a line, for any engine to run with `snell run`
///
/// A job is named by a hash of everything that it is asked, so the same study gives the same ids on
/// every machine with the same version. Nothing is rendered.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    study: StudyArgs,
    /// Print only the ids
    #[arg(long)]
    ids: bool,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let spec = args.study.spec(output)?;
    let grid = expand(&spec)?;
    check(&spec, &grid)?;
    for job in grid.jobs() {
        if args.ids && !output.json {
            output.line(job.id.as_str())?;
        } else {
            output.own_object(&job.line())?;
        }
    }
    Ok(Status::Done)
}
