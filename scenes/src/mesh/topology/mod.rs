//! Whether a mesh bounds a solid: edges, orientation, volume, genus.

mod convex;
pub(crate) mod edges;
mod orient;
mod report;
mod weld;

pub use convex::is_convex;
pub use orient::{NotOrientable, orient_outward};
pub use report::{NotSolid, Report, boundary_loops, inspect, signed_volume, unbalanced_edges};
pub use weld::{Removed, clean, weld};

#[cfg(test)]
mod tests;
