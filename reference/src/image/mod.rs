//! From pixels to layers: what an image is asked for, and how it is filled.

mod layer_table;
pub(crate) mod layers;
mod pixel;
pub(crate) mod plan;
mod rows;
pub(crate) mod run;
