//! Commands that hold images to what was accepted.

pub(super) mod baseline;
pub(super) mod check;
