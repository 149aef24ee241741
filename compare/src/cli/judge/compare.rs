//! `snell compare REF TEST`: metrics of two image files.

use crate::Error;
use crate::cli::arguments::values::exposures;
use crate::cli::output::{Output, table};
use crate::cli::status::Status;
use crate::image_pair::compare_files;
use crate::metric::{Exposures, Measurement};
use crate::results::{NotDone, Status as Usable};
use std::path::PathBuf;

/// Measure how far an image is from a reference: any two EXR, HDR or PNG files
///
/// EXR and HDR files are taken as linear radiance, PNG files as display code
/// values. Layers such as `exit` and `coverage` are used where the files have
/// them; what a pair cannot have is left out, with the reason.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Image that is taken as true
    reference: PathBuf,
    /// Image that is judged
    test: PathBuf,
    /// Exposures of HDR-FLIP: first and last in stops, and how many
    /// [default: from the reference]
    #[arg(long, value_name = "START,STOP,COUNT", value_parser = exposures)]
    flip_exposures: Option<Exposures>,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let judgement = compare_files(&args.reference, &args.test, args.flip_exposures)?;
    if output.json {
        for measurement in &judgement.measurements {
            output.object("snell.measurement/1", measurement)?;
        }
    } else {
        output.line(&table(&text(&judgement.measurements)))?;
        output.line(&left_out(&judgement.left_out))?;
    }
    let invalid = |m: &Measurement| m.status == Usable::Invalid;
    match judgement.measurements.iter().find(|m| invalid(m)) {
        Some(m) => Err(Error::Image { path: args.test.clone(), why: m.reason.clone() }),
        None => Ok(Status::Done),
    }
}

fn text(measurements: &[Measurement]) -> Vec<Vec<String>> {
    let heading = ["metric", "pixels", "value", "unit", "n"].map(str::to_owned).to_vec();
    let row = |m: &Measurement| {
        let value = m.value.map_or_else(|| m.reason.clone(), |value| format!("{value:.6}"));
        let mask = format!("{:?}", m.mask).to_lowercase();
        vec![m.metric.clone(), mask, value, m.unit.to_owned(), m.n.to_string()]
    };
    std::iter::once(heading).chain(measurements.iter().map(row)).collect()
}

fn left_out(list: &[NotDone]) -> String {
    let lines = list.iter().map(|left| format!("left out: {}: {}", left.what, left.reason));
    lines.collect::<Vec<_>>().join("\n")
}
