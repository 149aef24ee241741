//! `snell methods`: the approximations, their parameters and their papers, and the
//! layers and flags that all of them have.

use crate::Error;
use crate::cli::output::Output;
use crate::cli::status::Status;
use realtime::methods::{Kind, LAYERS, METHODS, Method, Parameter};
use scenes::rendering::layer::flag;
use serde::Serialize;

/// List the approximations, with parameters and citations, and the layers and flags of their images
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
    layers: Vec<LayerAnswer>,
    flags: Vec<FlagAnswer>,
}

/// A layer, for programs.
#[derive(Serialize)]
struct LayerAnswer {
    name: &'static str,
    meaning: &'static str,
}

/// A bit of the layer `flags`, for programs.
#[derive(Serialize)]
struct FlagAnswer {
    name: &'static str,
    bit: u32,
    meaning: &'static str,
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
    if !output.json {
        layers_and_flags(output)?;
    }
    Ok(Status::Done)
}

fn layers_and_flags(output: Output) -> Result<(), Error> {
    output.line("layers, of every method (--layers)")?;
    let rows = LAYERS.map(|(name, meaning)| vec![format!("  {name}"), meaning.to_owned()]);
    output.line(&left_aligned(&rows))?;
    output.line("bits of the layer flags")?;
    let row = |(name, bit, meaning): (&str, u32, &str)| {
        vec![format!("  {bit}"), name.to_owned(), meaning.to_owned()]
    };
    output.line(&left_aligned(&flag::ALL.map(row)))
}

/// Columns of text, the last as wide as it is.
fn left_aligned(rows: &[Vec<String>]) -> String {
    let widest = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let line = |row: &Vec<String>| {
        let cells = row.iter().enumerate();
        let cells = cells.map(|(column, cell)| format!("{cell:<w$}", w = widest(column)));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}

impl From<&Method> for Answer {
    fn from(method: &Method) -> Self {
        let Method { id, alias, title, about, bibtex, parameters, .. } = *method;
        let parameters = parameters.iter().map(ParameterAnswer::from).collect();
        let layers = LAYERS.map(|(name, meaning)| LayerAnswer { name, meaning }).into();
        let flags = flag::ALL.map(|(name, bit, meaning)| FlagAnswer { name, bit, meaning }).into();
        Self { id, alias, title, about, bibtex, parameters, layers, flags }
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
