//! What stands inside a body of ice: bumps from noise, cracks and air.

pub mod air;
mod columns;
pub mod crack;
pub mod noise;
mod pose;
