//! The judgement.

pub mod cache;
mod error;
pub mod jobs;
pub mod results;

pub use error::Error;
