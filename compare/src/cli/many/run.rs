//! `snell run`: some of the jobs of a study, into a store.

use crate::Error;
use crate::cli::Status;
use crate::cli::arguments::adapter::AdapterArg;
use crate::cli::arguments::study::StudyArgs;
use crate::cli::output::Output;
use crate::study::shelf::{Placed, Share, fill};
use std::path::PathBuf;

/// Run jobs of a study and put their results into a store, which any number of machines may share
///
/// A result is stored whole or not at all and never made twice: run the same again after whatever
/// went wrong.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    study: StudyArgs,
    /// Run the job of this id; repeat for several [default: all jobs]
    #[arg(long = "job", value_name = "ID")]
    jobs: Vec<String>,
    /// Run part I, from 0, of N parts of the list
    #[arg(long, value_name = "I/N", value_parser = shard, conflicts_with = "jobs")]
    shard: Option<Share>,
    /// Folder of results by id
    #[arg(short = 'o', long = "store", value_name = "STORE")]
    store: PathBuf,
    /// Folder of exact images that were traced before [default: `exact` in the store]
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArg,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let spec = args.study.spec(output)?;
    let share = match &args.shard {
        Some(shard) => shard.clone(),
        None if args.jobs.is_empty() => Share::All,
        None => Share::Ids(args.jobs.clone()),
    };
    let mut told = |placed: &Placed| {
        if output.json {
            return output.object("snell.placed/1", placed);
        }
        let how = match placed.found {
            true => "was there".to_owned(),
            false => format!("{:.2} s", placed.seconds),
        };
        output.line(&format!("{} {} {}: {how}", placed.id, placed.scene, placed.method))
    };
    let mut gpu = || args.adapter.open();
    fill(&spec, &share, &mut gpu, &args.store, args.cache.clone(), &mut told)?;
    Ok(Status::Done)
}

/// Reads `I/N`.
fn shard(text: &str) -> Result<Share, String> {
    let parts = text.split_once('/').and_then(|(index, count)| {
        Some((index.trim().parse::<usize>().ok()?, count.trim().parse::<usize>().ok()?))
    });
    match parts {
        Some((index, count)) if index < count && count <= 1_000_000 => {
            Ok(Share::Part { index, count })
        }
        _ => Err("write I/N with I from 0 to N - 1, such as 0/100".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Share, shard};

    #[test]
    fn a_shard_counts_from_zero() {
        assert_eq!(shard("2/3"), Ok(Share::Part { index: 2, count: 3 }));
        for wrong in ["3/3", "1", "/", "0/0", "-1/3", "1/99999999"] {
            assert!(shard(wrong).is_err(), "{wrong}");
        }
    }
}
