//! What every part of the judgement stands on.

pub(crate) mod clock;
pub(crate) mod files;
pub mod progress;
pub(crate) mod repeats;
pub mod statistics;
pub mod sum;
pub(crate) mod utc;
