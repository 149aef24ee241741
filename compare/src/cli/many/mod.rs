//! A study over many processes and machines.

pub(super) mod collect;
pub(super) mod jobs;
pub(super) mod run;
