//! `snell scenes`: the built-in scenes, and their text to start from.

use crate::Error;
use crate::cli::output::{Output, table};
use crate::cli::status::Status;
use scenes::Builtin;
use serde::Serialize;
use std::path::PathBuf;

/// List the built-in scenes, or print one as a start for your own
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Built-in scene to print
    scene: Option<String>,
}

/// The answer for programs.
#[derive(Serialize)]
struct Answer<'a> {
    name: &'a str,
    title: &'a str,
    in_default_study: bool,
    in_quick_study: bool,
    /// File it needs that set-up has not fetched.
    missing: Option<PathBuf>,
    text: &'a str,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let mut list: Vec<&Builtin> = scenes::builtins().iter().collect();
    if let Some(name) = &args.scene {
        list.retain(|builtin| builtin.name == name);
        if list.is_empty() {
            // Says which names there are.
            scenes::builtin(name)?;
        }
    }
    let mut rows = Vec::new();
    for builtin in list {
        let (title, missing) = (builtin.title(), builtin.missing());
        if output.json {
            let Builtin { name, text, in_default_study, in_quick_study, .. } = *builtin;
            let title = title.as_str();
            let answer = Answer { name, title, in_default_study, in_quick_study, missing, text };
            output.object("snell.scene/1", &answer)?;
        } else if args.scene.is_some() {
            output.line(builtin.text.trim_end())?;
        } else {
            let studies = match (builtin.in_quick_study, builtin.in_default_study) {
                (true, _) => "quick, default",
                (false, true) => "default",
                (false, false) => "",
            };
            let needs = missing.map(|file| format!(" (needs {}: `make setup`)", file.display()));
            let about = title + &needs.unwrap_or_default();
            rows.push(vec![builtin.name.to_owned(), studies.to_owned(), about]);
        }
    }
    if !rows.is_empty() {
        rows.insert(0, ["scene", "in studies", "title"].map(str::to_owned).to_vec());
        output.line(&table(&rows))?;
    }
    Ok(Status::Done)
}
