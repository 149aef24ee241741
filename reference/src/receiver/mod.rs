//! An opaque face that receives light, and a map of the light on it.
//!
//! It lies below requests, which may ask for such a map; how one is made is in
//! `caustics`.

pub(crate) mod face;
pub(crate) mod map;
