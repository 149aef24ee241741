//! The judgement.

pub mod cache;
mod error;
pub mod image_pair;
pub mod jobs;
pub mod metric;
pub mod results;

pub use error::Error;
