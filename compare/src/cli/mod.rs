//! The command line. Each command is a file here: its arguments, whose comments
//! are the help, and `run`, which answers on standard output.

mod arguments;
mod describe;
mod gate;
mod judge;
mod many;
mod output;
mod render;
mod status;
mod warnings;

use crate::Error;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use describe::{adapters, export, mesh, methods, plan, scenes, schema, shell};
use gate::{baseline, check};
use judge::{bench, compare, report, study};
use many::{collect, jobs, run};
use output::Output;
use render::{caustics, realtime, reference};
use serde::Serialize;
use status::{EXIT_STATUS, Status};
use std::io::Write;
use std::process::ExitCode;
use warnings::Warnings;

/// How wrong is real-time refraction, and what does it cost?
#[derive(Debug, Parser)]
#[command(name = "snell", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Answer with one JSON object per line
    #[arg(long, global = true)]
    json: bool,
    /// End with exit status 2 where there would be a warning
    #[arg(long, global = true)]
    deny_warnings: bool,
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
    Jobs(jobs::Args),
    Run(run::Args),
    Collect(collect::Args),
    Report(report::Args),
    Mesh(mesh::Args),
    Export(export::Args),
    Baseline(baseline::Args),
    Check(check::Args),
    Bench(bench::Args),
    Schema(schema::Args),
    Completions(shell::CompletionsArgs),
    Man(shell::ManArgs),
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
            Self::Jobs(args) => jobs::run(args, output),
            Self::Run(args) => run::run(args, output),
            Self::Collect(args) => collect::run(args, output),
            Self::Report(args) => report::run(args, output),
            Self::Mesh(args) => mesh::run(args, output),
            Self::Export(args) => export::run(args, output),
            Self::Baseline(args) => baseline::run(args, output),
            Self::Check(args) => check::run(args, output),
            Self::Bench(args) => bench::run(args, output),
            Self::Schema(args) => schema::run(args, output),
            Self::Completions(args) => shell::completions(args, program(), output),
            Self::Man(args) => shell::man(args, program(), output),
        }
    }
}

/// Runs the command line of this process.
#[must_use]
pub fn main() -> ExitCode {
    quiet_the_driver();
    let cli = parse();
    // One for the whole process, so that every part of it can tell.
    let warnings = Box::leak(Box::new(Warnings::new(cli.deny_warnings)));
    let output = Output { json: cli.json, warnings };
    match cli.command.run(output) {
        Ok(status) => ExitCode::from(status as u8),
        // Whoever read the answer has seen enough of it, such as `head`.
        Err(Error::Output(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(error) => {
            tell(&error.to_string(), cli.json);
            ExitCode::from(2)
        }
    }
}

/// An error for programs.
#[derive(Serialize)]
struct Failure<'a> {
    schema: &'a str,
    /// What, where, and what to write instead.
    message: &'a str,
    exit_status: u8,
}

/// Tells why there is no answer: on standard error, as text or as an object.
fn tell(message: &str, json: bool) {
    let failure = Failure { schema: "snell.error/1", message, exit_status: 2 };
    let object = if json { serde_json::to_string(&failure).ok() } else { None };
    // Nobody listens if standard error is closed.
    let _ =
        writeln!(std::io::stderr(), "{}", object.unwrap_or_else(|| format!("error: {message}")));
}

/// Starts this program again, in the same process, where the GPU's driver would
/// otherwise complain on standard error of things that have nothing to do with it.
fn quiet_the_driver() {
    #[cfg(unix)]
    if let (Some((name, value)), Ok(program)) = (::realtime::noise(), std::env::current_exe()) {
        use std::os::unix::process::CommandExt;
        // It returns only if it failed, and then there are two lines too many.
        let _ = std::process::Command::new(program)
            .args(std::env::args_os().skip(1))
            .env(name, value)
            .exec();
    }
}

/// The arguments of this process. Wrong ones end it with exit status 2.
fn parse() -> Cli {
    let read = program().try_get_matches().and_then(|found| Cli::from_arg_matches(&found));
    read.unwrap_or_else(|error| {
        // Help and the version are errors to clap, and answers to people.
        if error.use_stderr() && std::env::args().any(|word| word == "--json") {
            let message = error.to_string();
            tell(message.trim_start_matches("error: ").trim_end(), true);
            std::process::exit(2);
        }
        error.exit()
    })
}

/// The commands and their options, each with the exit status at the end of its help.
fn program() -> clap::Command {
    // A command that can end in more ways says so in its own words.
    Cli::command().mut_subcommands(|command| match command.get_after_help() {
        Some(_) => command,
        None => command.after_help(EXIT_STATUS),
    })
}
