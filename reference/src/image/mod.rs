//! From pixels to layers: what an image is asked for, and how it is filled.

pub(crate) mod job;
pub(crate) mod layers;
pub(crate) mod pixel;
pub(crate) mod plan;
