//! The argument that picks a GPU.

use crate::Error;
use realtime::Gpu;

/// Which GPU to use.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct AdapterArg {
    /// GPU to use: its index or part of its name in `snell adapters` [default: the fastest kind]
    #[arg(long, value_name = "NAME|INDEX")]
    adapter: Option<String>,
}

impl AdapterArg {
    pub(in crate::cli) fn open(&self) -> Result<Gpu, Error> {
        Ok(Gpu::open(self.adapter.as_deref())?)
    }

    /// The one that was named, or any; none if there is none at all.
    pub(in crate::cli) fn open_if_any(&self) -> Result<Option<Gpu>, Error> {
        match Gpu::open(self.adapter.as_deref()) {
            Err(realtime::Error::NoAdapter) if self.adapter.is_none() => Ok(None),
            opened => Ok(Some(opened?)),
        }
    }
}
