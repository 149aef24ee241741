//! What stands inside a body of ice: bumps from noise, cracks and air, and how
//! deep under the surface a place is.

pub mod air;
mod columns;
pub mod crack;
pub mod distance;
pub mod noise;
mod pose;
