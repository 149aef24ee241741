//! `snell methods`: the approximations, their parameters and their papers.

use crate::Error;
use crate::cli::output::Output;
use crate::cli::status::Status;
use realtime::methods::{Kind, METHODS, Method, Parameter};
use serde::Serialize;

/// List the approximations, with parameters and citations
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Print the citations as BibTeX
    #[arg(long, conflicts_with = "json")]
    bibtex: bool,
}

/// A method, for programs.
#[derive(Serialize)]
struct Answer {
    id: &'static str,
    alias: &'static str,
    title: &'static str,
    about: &'static str,
    bibtex: &'static str,
    parameters: Vec<ParameterAnswer>,
}

#[derive(Serialize)]
struct ParameterAnswer {
    name: &'static str,
    default: String,
    range: String,
    unit: &'static str,
    help: &'static str,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    if args.bibtex {
        let mut entries: Vec<&str> = METHODS.iter().map(|method| method.bibtex).collect();
        entries.sort_unstable();
        entries.dedup();
        entries.retain(|entry| !entry.is_empty());
        output.line(&entries.join("\n\n"))?;
        return Ok(Status::Done);
    }
    for answer in METHODS.iter().map(Answer::from) {
        if output.json {
            output.object("snell.method/1", &answer)?;
        } else {
            output.line(&answer.text())?;
        }
    }
    Ok(Status::Done)
}

impl From<&Method> for Answer {
    fn from(method: &Method) -> Self {
        let Method { id, alias, title, about, bibtex, parameters, .. } = *method;
        let parameters = parameters.iter().map(ParameterAnswer::from).collect();
        Self { id, alias, title, about, bibtex, parameters }
    }
}

impl From<&Parameter> for ParameterAnswer {
    fn from(parameter: &Parameter) -> Self {
        let Parameter { name, unit, help, kind } = parameter;
        let (default, range) = match kind {
            Kind::Number { default, min, max, .. } => {
                (default.to_string(), format!("{min} to {max}"))
            }
            Kind::Choice(words) => {
                (words.first().copied().unwrap_or_default().to_owned(), words.join(" | "))
            }
        };
        Self { name, default, range, unit, help }
    }
}

impl Answer {
    fn text(&self) -> String {
        let mut lines = vec![format!("{} ({}): {}", self.id, self.alias, self.title)];
        lines.push(format!("    {}", self.about));
        lines.extend(self.parameters.iter().map(|p| {
            let unit = if p.unit.is_empty() { String::new() } else { format!(" {}", p.unit) };
            format!("    {} = {} [{}{unit}]: {}", p.name, p.default, p.range, p.help)
        }));
        lines.join("\n")
    }
}
