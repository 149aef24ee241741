//! The judgement.

pub mod cache;
pub mod cli;
mod error;
pub mod image_pair;
pub mod jobs;
pub mod metric;
pub mod progress;
pub mod report;
pub mod results;

pub use error::Error;
