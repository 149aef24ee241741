//! The judgement.

pub mod results;
