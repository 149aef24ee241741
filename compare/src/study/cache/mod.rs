//! Results that need not be computed again.

mod id;
mod store;

pub(in crate::study) use id::hex;
pub use id::{FORMAT, Id};
pub(in crate::study) use store::CANNOT_BE_WRITTEN;
pub use store::{Found, Store};

use std::env;
use std::path::{Path, PathBuf};

/// Where results are kept unless the user names a folder: in a checkout of this
/// project below its build folder, else in the user's own cache folder. `None`
/// where there is none that is the user's alone.
#[must_use]
pub fn default_folder() -> Option<PathBuf> {
    let checkout = Path::new("target");
    if checkout.join("CACHEDIR.TAG").exists() && Path::new("compare/Cargo.toml").exists() {
        return Some(checkout.join("snell-cache"));
    }
    let named = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    named("XDG_CACHE_HOME")
        .or_else(|| named("LOCALAPPDATA"))
        .or_else(|| named("HOME").map(|home| home.join(".cache")))
        .map(|folder| folder.join("snell"))
}
