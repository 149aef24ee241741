//! `snell completions` and `snell man`: what a shell and a reader of manuals want.

use crate::Error;
use crate::cli::output::Output;
use crate::cli::status::Status;
use clap::Command;
use clap_complete::Shell;
use std::io::{self, Write};

/// Print what makes a shell complete the commands and options of snell
///
/// For example: snell completions bash > ~/.local/share/bash-completion/completions/snell
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct CompletionsArgs {
    /// Which shell
    shell: Shell,
}

/// Print the manual page of snell, or of one of its commands
///
/// For example: snell man > snell.1; snell man study | man -l -
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct ManArgs {
    /// The command [default: snell itself]
    command: Option<String>,
}

pub(in crate::cli) fn completions(
    args: &CompletionsArgs,
    mut program: Command,
    output: Output,
) -> Result<Status, Error> {
    refuse_json(output)?;
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut program, "snell", &mut text);
    written(&text)
}

pub(in crate::cli) fn man(
    args: &ManArgs,
    mut program: Command,
    output: Output,
) -> Result<Status, Error> {
    refuse_json(output)?;
    program.build();
    let of = match &args.command {
        None => program,
        Some(name) => program.find_subcommand(name).cloned().ok_or_else(|| {
            let names: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            Error::Usage(format!("\"{name}\" is no command\nwrite one of {}", names.join(", ")))
        })?,
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(of).render(&mut text).map_err(Error::Output)?;
    written(&text)
}

fn refuse_json(output: Output) -> Result<(), Error> {
    match output.json {
        true => Err(Error::Usage("--json: this answer is no data\nleave it out".to_owned())),
        false => Ok(()),
    }
}

fn written(text: &[u8]) -> Result<Status, Error> {
    io::stdout().lock().write_all(text).map_err(Error::Output)?;
    Ok(Status::Done)
}
