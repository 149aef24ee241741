//! The judgement.

pub mod bench;
pub mod cli;
mod error;
pub mod gate;
pub mod image_pair;
pub mod metric;
pub mod report;
pub mod results;
pub mod study;
pub mod support;

pub use error::Error;
