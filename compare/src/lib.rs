//! The judgement.

pub mod bench;
pub mod cache;
pub mod cli;
mod error;
mod file;
pub mod image_pair;
pub mod jobs;
pub mod metric;
pub mod progress;
pub mod report;
pub mod results;
pub mod study;

pub use error::Error;
