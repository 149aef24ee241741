//! Arguments that several commands share.

pub(super) mod adapter;
pub(super) mod exact;
pub(super) mod external;
pub(super) mod study;
pub(super) mod values;
pub(super) mod view;

use crate::Error;
use scenes::Scene;

/// The scene of that name: built in, or a file.
pub(super) fn scene(name: &str) -> Result<Scene, Error> {
    Ok(scenes::find(name)?)
}
