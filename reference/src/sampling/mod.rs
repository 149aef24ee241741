//! Where samples lie.

pub(crate) mod lattice;
pub(crate) mod sobol;
