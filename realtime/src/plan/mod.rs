//! Plans: what a frame's passes add to one, and what really happened, to set beside
//! it.

pub(crate) mod counted;
pub(crate) mod entries;
pub(crate) mod timing;
