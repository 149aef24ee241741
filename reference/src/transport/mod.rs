//! The ways light takes through a world, from event to event.

pub(crate) mod branching;
pub(crate) mod chain;
pub(crate) mod media_optics;
mod opaque_surface;
pub(crate) mod path;
mod polarised_tree;
mod restart;
pub(crate) mod spectrum;
pub(crate) mod tracer;
pub(crate) mod tree;
pub(crate) mod variant;
