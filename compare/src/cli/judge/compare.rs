//! `snell compare REF TEST`: metrics of two image files.

use crate::Error;
use crate::cli::arguments::values::{alpha, display_ev, exposures};
use crate::cli::output::{Output, table};
use crate::cli::status::Status;
use crate::gate::limit::{self, Limit};
use crate::gate::verdict::worst;
use crate::image_pair::{Comparison, Question, compare_files};
use crate::metric::{Exposures, Mask, Measurement};
use crate::results::{NotDone, Validity};
use scenes::image::Alpha;
use schemars::JsonSchema;
use serde::Serialize;
use std::path::PathBuf;

/// Measure how far an image is from a reference: any two image files
///
/// OpenEXR, Radiance, PFM and float TIFF files are linear radiance; PNG, TIFF,
/// JPEG, WebP, TGA, BMP, PPM and QOI files are display code values. Layers such
/// as `exit` and `coverage` are used where the files have them; what a pair
/// cannot have is left out, with the reason. FILE.exr:LAYER takes one layer of an
/// OpenEXR file as the image.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Image that is taken as true
    reference: PathBuf,
    /// Image that is judged
    test: PathBuf,
    /// Exposures of HDR-FLIP: first and last in stops, and how many
    /// [default: from the reference]
    #[arg(
        long,
        value_name = "START,STOP,COUNT",
        value_parser = exposures,
        allow_hyphen_values = true
    )]
    flip_exposures: Option<Exposures>,
    /// What transparent pixels lie over: over-black, over-white, or ignore to take
    /// colours as they are stored
    #[arg(long, value_name = "HOW", value_parser = alpha, default_value = "over-black")]
    alpha: Alpha,
    /// Compare as display images: multiply linear radiance by 2 to the power of
    /// STOPS, clamp it to 0..1 and encode it as sRGB
    #[arg(long, value_name = "ev=STOPS", value_parser = display_ev, allow_hyphen_values = true)]
    display: Option<f64>,
    /// Fail, with exit status 1, beyond this: most, or least where more is better, such as
    /// flip_hdr=0.05; over all pixels; repeat for several
    #[arg(long = "limit", value_name = "NAME=VALUE", value_parser = Limit::read)]
    limits: Vec<Limit>,
}

/// Schema of a line of the answer.
pub(in crate::cli) const SCHEMA: &str = "snell.measurement/2";

/// A line of the answer for programs.
#[derive(Serialize, JsonSchema)]
pub(in crate::cli) struct Line<'a> {
    #[serde(flatten)]
    measurement: &'a Measurement,
    /// Lower end of the 95 % interval, where one is known.
    ci_lo: Option<f64>,
    /// Upper end of the 95 % interval.
    ci_hi: Option<f64>,
    /// What transparent pixels lie over; `none` where both files are opaque.
    alpha: &'static str,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let (flip_exposures, alpha, display_ev) = (args.flip_exposures, args.alpha, args.display);
    let question = Question { flip_exposures, alpha, display_ev };
    let Comparison { judgement, has_alpha, warnings } =
        compare_files(&args.reference, &args.test, &question)?;
    output.warnings.tell(warnings)?;
    let alpha = if has_alpha { alpha.name() } else { "none" };
    if output.json {
        for measurement in &judgement.measurements {
            let (ci_lo, ci_hi) = measurement.interval.unzip();
            output.object(SCHEMA, &Line { measurement, ci_lo, ci_hi, alpha })?;
        }
    } else {
        output.line(&table(&text(&judgement.measurements)))?;
        output.line(&left_out(&judgement.left_out))?;
        output.line(&format!("alpha: {alpha}"))?;
    }
    if !args.limits.is_empty() {
        return held(args, &judgement.measurements, output);
    }
    let invalid = |m: &Measurement| m.status == Validity::Invalid;
    match judgement.measurements.iter().find(|m| invalid(m)) {
        Some(m) => Err(Error::Image { path: args.test.clone(), why: m.reason.clone() }),
        None => Ok(Status::Done),
    }
}

/// Says which limits hold. An image with NaN or infinity holds none.
fn held(args: &Args, measurements: &[Measurement], output: Output) -> Result<Status, Error> {
    let pair = args.test.display().to_string();
    let checks =
        limit::check(&pair, measurements, Mask::All, &args.limits).map_err(Error::Usage)?;
    for check in &checks {
        if output.json {
            output.object("snell.check/1", check)?;
            continue;
        }
        let value = check.head.map_or_else(|| "no value".to_owned(), |value| format!("{value:.6}"));
        let limit = check.margin.unwrap_or_default();
        let (outcome, metric) = (check.outcome.word(), &check.metric);
        let reason = if check.reason.is_empty() { "" } else { ": " };
        output.line(&format!("{outcome}: {metric} {limit}: {value}{reason}{}", check.reason))?;
    }
    Ok(Status::from(worst(&checks)))
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
