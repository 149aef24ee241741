//! Commands that make an image.

pub(super) mod caustics;
mod progressive;
pub(super) mod realtime;
pub(super) mod reference;
