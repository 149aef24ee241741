//! `snell adapters`: what wgpu sees on this machine.

use crate::Error;
use crate::cli::output::{Output, table};
use crate::cli::status::Status;

/// List the GPU adapters of this machine, software ones included
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {}

pub(in crate::cli) fn run(_args: &Args, output: Output) -> Result<Status, Error> {
    let adapters = realtime::adapters();
    if adapters.is_empty() {
        return Err(realtime::Error::NoAdapter.into());
    }
    if output.json {
        for adapter in &adapters {
            output.object("snell.adapter/1", adapter)?;
        }
        return Ok(Status::Done);
    }
    let mut rows = vec![["index", "name", "backend", "kind", "driver"].map(str::to_owned).to_vec()];
    rows.extend(adapters.iter().map(|a| {
        let kind = if a.software { "software" } else { "hardware" };
        vec![a.index.to_string(), a.name.clone(), a.backend.clone(), kind.into(), a.driver.clone()]
    }));
    output.line(&table(&rows))?;
    Ok(Status::Done)
}
