//! The ways light takes through a world, from event to event.

pub(crate) mod branching;
pub(crate) mod chain;
pub(crate) mod media_optics;
pub(crate) mod opaque_surface;
pub(crate) mod polarised_tree;
pub(crate) mod restart;
pub(crate) mod spectrum;
pub(crate) mod tracer;
pub(crate) mod tree;
