//! Where exact images are kept.

use crate::Error;
use crate::cli::output::Output;
use crate::study::cache::{self, Store};
use std::path::Path;

const NO_HOME: &str = "there is no home folder for a cache: exact images are kept for this run \
                       only; name a folder with --cache";

/// The store in the folder that was named, or in the user's own. Without one, the
/// user is told that images are kept for this run only.
pub(in crate::cli) fn store(folder: Option<&Path>, output: Output) -> Result<Store, Error> {
    match folder.map(Path::to_owned).or_else(cache::default_folder) {
        Some(folder) => Ok(Store::new(folder)),
        None => {
            output.warnings.tell([NO_HOME.to_owned()])?;
            Store::for_this_run()
        }
    }
}
