//! Gates: does a change make a method worse, and how sure is that?
//!
//! Read this first. A *cell* is one image that is watched: a method on a scene,
//! or one of somebody's image files. Its *base* is the image that was accepted,
//! its *head* the image of now, its *truth* the exact image; all three lie in one
//! *baseline* file or are made anew. Of each cell the paired differences of head
//! and base against the same truth are judged ([`difference`]), those of all
//! cells together ([`verdict`]).

mod adapter_class;
pub mod cell;
pub mod difference;
pub mod file;
pub mod limit;
pub mod output;
#[cfg(test)]
mod power;
pub mod run;
pub mod time;
pub mod verdict;

pub use crate::error::GateError;
pub use adapter_class::AdapterClass;
