//! `snell check`: has anything got worse?

use crate::Error;
use crate::cli::arguments::adapter::AdapterArg;
use crate::cli::arguments::cache::store;
use crate::cli::output::{Output, table as aligned};
use crate::cli::status::Status;
use crate::gate::GateError;
use crate::gate::file::pairs::PairGate;
use crate::gate::file::scenes::SceneGate;
use crate::gate::output::{command, github, junit, table, triple};
use crate::gate::run::{Checked, SceneOptions, check_pairs, check_scenes};
use crate::gate::time::{self, FEWEST_TURNS, Program};
use crate::gate::verdict::Outcome;
use crate::support::files::{self, FileError};
use crate::support::progress::Progress;
use realtime::Gpu;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Hold images of now to the baseline: is any method worse than it was?
///
/// Head (now) and base (accepted) are compared with the same exact image. A
/// check fails where head is surely worse by more than its margin, and is
/// inconclusive where its interval is wider than the margin.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// The gate: which methods are watched on which scenes
    #[arg(default_value = "gate.toml", value_name = "GATE.toml")]
    gate: PathBuf,
    /// Hold a list of anybody's image pairs to limits and to their baseline
    #[arg(long, value_name = "PAIRS.toml", conflicts_with = "gate")]
    pairs: Option<PathBuf>,
    /// Leave out cells that the gate has `quick = false` for: what CI runs
    #[arg(long, conflicts_with = "pairs")]
    quick: bool,
    /// Judge only cells whose names start so; repeat for several
    #[arg(long, value_name = "CELL")]
    only: Vec<String>,
    /// Render head with another parameter than the gate's, to see that the gate notices; repeat for
    /// several
    #[arg(long, value_name = "METHOD.NAME=VALUE", value_parser = instead, conflicts_with = "pairs")]
    head_param: Vec<(String, String, String)>,
    /// Time head and the `snell` of this commit in turns too, and fail where head is surely slower
    /// by a tenth: builds that commit below target/gate
    #[arg(long, value_name = "GIT", conflicts_with_all = ["pairs", "base_program"])]
    base_ref: Option<String>,
    /// As --base-ref, with a `snell` that is built already
    #[arg(long, value_name = "FILE", conflicts_with = "pairs")]
    base_program: Option<PathBuf>,
    /// Turns of each cell, with --base-ref or --base-program
    #[arg(long, value_name = "N", default_value_t = FEWEST_TURNS,
        value_parser = clap::value_parser!(u32).range(i64::from(FEWEST_TURNS)..=1000))]
    turns: u32,
    /// Folder for the images of each cell that does not pass
    #[arg(short, long, value_name = "DIR", default_value = "gate-out")]
    out: PathBuf,
    /// Write the result as JUnit XML too
    #[arg(long, value_name = "FILE.xml")]
    junit: Option<PathBuf>,
    /// Print annotations for GitHub and write its step summary [default: where GITHUB_ACTIONS=true]
    #[arg(long)]
    github: bool,
    /// Folder of exact images that were traced before [default: as `snell study`]
    #[arg(long, value_name = "DIR")]
    cache: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArg,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let checked = match &args.pairs {
        Some(pairs) => check_pairs(&PairGate::read(pairs)?, &args.only)?,
        None => scenes(args, output)?,
    };
    answer(&checked, output)?;
    images(&checked, args, output)?;
    if let Some(path) = &args.junit {
        let xml = junit::xml(&checked).map_err(|reason| GateError::file(path, reason))?;
        files::write(path, xml.as_bytes())?;
    }
    if args.github || std::env::var_os("GITHUB_ACTIONS").is_some_and(|value| value == "true") {
        tell_github(&checked)?;
    }
    Ok(Status::from(checked.outcome()))
}

fn scenes(args: &Args, output: Output) -> Result<Checked, Error> {
    let gate = SceneGate::read(&args.gate)?;
    let mut by_method: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    for (method, name, value) in &args.head_param {
        let method = realtime::Method::find(method)?.id.to_owned();
        if !gate.cells.iter().any(|cell| cell.method == method) {
            return Err(Error::Usage(format!("--head-param: the gate has no cell of {method}")));
        }
        by_method.entry(method).or_default().insert(name.clone(), value.clone());
    }
    let options = SceneOptions { quick: args.quick, only: args.only.clone(), instead: by_method };
    let gpu = args.adapter.open()?;
    let store = store(args.cache.as_deref(), output)?;
    let progress = Progress::new("");
    let mut checked = check_scenes(&gate, &options, &gpu, &store, &|cell| progress.now(cell))?;
    times(args, &gate, &gpu, &mut checked, &|cell| progress.now(cell))?;
    Ok(checked)
}

/// Adds the ratio of times of every judged cell, if a base was named.
fn times(
    args: &Args,
    gate: &SceneGate,
    gpu: &Gpu,
    checked: &mut Checked,
    now: &dyn Fn(&str),
) -> Result<(), Error> {
    let base = match (&args.base_ref, &args.base_program) {
        (Some(commit), _) => {
            now(&format!("building {commit}"));
            time::program_at(commit)?
        }
        (None, Some(program)) => program.clone(),
        (None, None) => return Ok(()),
    };
    let head =
        std::env::current_exe().map_err(FileError::of(Path::new("snell"), "is not found"))?;
    let adapter = vec!["--adapter".to_owned(), gpu.info().index.to_string()];
    let [head, base] = [head, base].map(|path| Program { path, adapter: adapter.clone() });
    for cell in gate.cells.iter().filter(|cell| checked.judged.contains(&cell.name)) {
        now(&format!("{}: time", cell.name));
        let size_px = gate.resolution_px;
        let of = |program: &Program| program.frame_ms(cell, size_px);
        let check = time::ratio(&cell.name, args.turns, || of(&head), || of(&base))?;
        checked.checks.push(check);
    }
    Ok(())
}

/// The table, or the rows.
fn answer(checked: &Checked, output: Output) -> Result<(), Error> {
    if output.json {
        for check in &checked.checks {
            output.object("snell.check/1", check)?;
        }
    } else {
        output.line(&aligned(&table::rows(checked)))?;
        output.line(&table::summary(checked))?;
    }
    let tell = |text: &str| match output.json {
        true => {
            Output::note(text);
            Ok(())
        }
        false => output.line(text),
    };
    checked.notes.iter().try_for_each(|note| tell(&format!("note: {note}")))?;
    checked.left_out.iter().try_for_each(|left| tell(&format!("left out: {left}")))?;
    let in_doubt = checked.in_doubt();
    if !in_doubt.is_empty() {
        tell(&format!("see it again:       {}", command::reproduce(checked, &in_doubt)))?;
        tell(&format!("if it is meant:     {}", command::accept(checked, &in_doubt)))?;
    }
    Ok(())
}

/// Exact, base and head of every cell in doubt.
fn images(checked: &Checked, args: &Args, output: Output) -> Result<(), Error> {
    let in_doubt = checked.in_doubt();
    for material in checked.material.iter().filter(|m| in_doubt.contains(&m.name.as_str())) {
        let folder = triple::write(material, &args.out)?;
        let text = format!("exact, base, head:  {}", folder.join("triple.png").display());
        if output.json {
            Output::note(&text);
        } else {
            output.line(&text)?;
        }
    }
    Ok(())
}

/// Annotations go to standard error, which the runner reads too: standard output
/// holds the answer.
fn tell_github(checked: &Checked) -> Result<(), Error> {
    github::annotations(checked).iter().for_each(|line| Output::note(line));
    let Some(path) = std::env::var_os("GITHUB_STEP_SUMMARY") else { return Ok(()) };
    let path = Path::new(&path);
    let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
    let written = file.and_then(|mut file| file.write_all(github::summary(checked).as_bytes()));
    Ok(written.map_err(FileError::unwritten(path))?)
}

impl From<Outcome> for Status {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Pass | Outcome::Warn => Self::Done,
            Outcome::Inconclusive => Self::Inconclusive,
            Outcome::Fail => Self::GateFailed,
        }
    }
}

/// Reads `METHOD.NAME=VALUE`.
fn instead(text: &str) -> Result<(String, String, String), String> {
    let form = || "write METHOD.NAME=VALUE, such as blended.a=0.4".to_owned();
    let (name, value) = text.split_once('=').ok_or_else(form)?;
    let (method, name) = name.split_once('.').ok_or_else(form)?;
    match [method, name, value].iter().all(|part| !part.trim().is_empty()) {
        true => Ok((method.trim().to_owned(), name.trim().to_owned(), value.trim().to_owned())),
        false => Err(form()),
    }
}
