//! `snell study`: every method on every scene, against the exact answer.

use crate::Error;
use crate::cli::Status;
use crate::cli::arguments::adapter::AdapterArg;
use crate::cli::arguments::cache::store;
use crate::cli::arguments::progress::ProgressArgs;
use crate::cli::arguments::study::StudyArgs;
use crate::cli::output::{Output, table};
use crate::results::{NotDone, ResultRow, Study};
use crate::study::{self, Estimate, summary};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Render scenes exactly and approximately, and report how far apart they are and what each costs
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    study: StudyArgs,
    /// Folder for the report, the results and the images
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Folder of exact images that were traced before [default: target/snell-cache in a checkout,
    /// else the user's cache folder]
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArg,
    #[command(flatten)]
    progress: ProgressArgs,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    args.progress.choose();
    let spec = args.study.spec(output)?;
    let gpu = args.adapter.open()?;
    let store = store(args.cache.as_deref(), output)?;
    let announce = |estimate: &Estimate| Output::note(&format!("snell study: {estimate}"));
    let command = command_line(std::env::args());
    let (study, rows) = study::run(&spec, &gpu, &store, &args.out, &command, announce)?;
    answer(&study, &rows, &args.out, output)
}

/// What a study ends with: its rows, or a table, what the curves say, and where the
/// report is.
pub(in crate::cli) fn answer(
    study: &Study,
    rows: &[ResultRow],
    out: &Path,
    output: Output,
) -> Result<Status, Error> {
    if output.json {
        for row in rows {
            output.own_object(row)?;
        }
        if !output.warnings.all().is_empty() {
            // Rows are flat, and have no place for them.
            output.object("snell.study.warnings/1", &BTreeMap::<&str, &str>::new())?;
        }
        return Ok(Status::Done);
    }
    output.line(&table(&summary(study, rows)))?;
    for reading in &study.readings {
        output.line(&format!("{}: {}", reading.scene, reading.text))?;
    }
    for NotDone { what, reason } in &study.left_out {
        output.line(&format!("left out: {what}: {}", reason.replace('\n', "; ")))?;
    }
    output.line(&format!("{} in {:.0} s", study.adapter, study.elapsed_s))?;
    output.line(&format!("report: {}", out.join("report.html").display()))?;
    Ok(Status::Done)
}

/// The command of this process as it can be typed again.
pub(in crate::cli) fn command_line(arguments: impl Iterator<Item = String>) -> String {
    let quoted = |argument: String| {
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:".contains(c);
        match !argument.is_empty() && argument.chars().all(plain) {
            true => argument,
            false => format!("'{}'", argument.replace('\'', "'\\''")),
        }
    };
    let typed = arguments.skip(1).map(quoted);
    std::iter::once("snell".to_owned()).chain(typed).collect::<Vec<_>>().join(" ")
}
