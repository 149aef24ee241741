//! The command line. Each command is a file here: its arguments, whose comments
//! are the help, and `run`, which answers on standard output.

mod adapter;
mod adapters;
mod bench;
mod caustics;
mod compare;
mod exact;
mod export;
mod methods;
mod output;
mod plan;
mod progressive;
mod realtime;
mod reference;
mod report;
mod scenes;
mod study;
mod view;

use crate::Error;
use crate::metric::Exposures;
use ::scenes::Scene;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use output::Output;
use std::io::Write;
use std::process::ExitCode;

const EXIT_STATUS: &str = "Exit status: 0 done, 1 a gate failed, 2 could not run, 3 inconclusive.";

/// How wrong is real-time refraction, and what does it cost?
#[derive(Debug, Parser)]
#[command(name = "snell", version, after_help = EXIT_STATUS, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Answer with one JSON object per line
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    Scenes(scenes::Args),
    Methods(methods::Args),
    Adapters(adapters::Args),
    Plan(plan::Args),
    Reference(reference::Args),
    Realtime(realtime::Args),
    Caustics(caustics::Args),
    Compare(compare::Args),
    Study(study::Args),
    Report(report::Args),
    Export(export::Args),
    Bench(bench::Args),
}

impl Command {
    fn run(&self, output: Output) -> Result<Status, Error> {
        match self {
            Self::Scenes(args) => scenes::run(args, output),
            Self::Methods(args) => methods::run(args, output),
            Self::Adapters(args) => adapters::run(args, output),
            Self::Plan(args) => plan::run(args, output),
            Self::Reference(args) => reference::run(args, output),
            Self::Realtime(args) => realtime::run(args, output),
            Self::Caustics(args) => caustics::run(args, output),
            Self::Compare(args) => compare::run(args, output),
            Self::Study(args) => study::run(args, output),
            Self::Report(args) => report::run(args, output),
            Self::Export(args) => export::run(args, output),
            Self::Bench(args) => bench::run(args, output),
        }
    }
}

/// How a command ended, if it could run at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
enum Status {
    /// It did what it was asked.
    Done = 0,
}

/// Runs the command line of this process.
#[must_use]
pub fn main() -> ExitCode {
    let cli = parse();
    let output = Output { json: cli.json };
    match cli.command.run(output) {
        Ok(status) => ExitCode::from(status as u8),
        // Whoever read the answer has seen enough of it, such as `head`.
        Err(Error::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::from(2)
        }
    }
}

/// The arguments of this process. Wrong ones end it with exit status 2.
fn parse() -> Cli {
    // What holds for every command is written once and shown in every help.
    let command = Cli::command().mut_subcommands(|command| command.after_help(EXIT_STATUS));
    Cli::from_arg_matches(&command.get_matches()).unwrap_or_else(|error| error.exit())
}

/// Reads `START,STOP,COUNT`.
fn exposures(text: &str) -> Result<Exposures, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let [start, stop, count] = parts[..] else {
        return Err("write START,STOP,COUNT, such as -4,2,7".to_owned());
    };
    let stops = |text: &str| {
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| format!("`{text}` is no number of stops"))
    };
    let count = count.parse().ok().filter(|count| (2..=64).contains(count));
    let count = count.ok_or("COUNT is a whole number from 2 to 64")?;
    Ok(Exposures { start: stops(start)?, stop: stops(stop)?, count })
}

/// The scene of that name: built in, or a file.
fn scene(name: &str) -> Result<Scene, Error> {
    Ok(::scenes::find(name)?)
}
