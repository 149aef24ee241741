//! Whether a mesh bounds a solid: edges, orientation, volume, genus.

mod convex;
pub(crate) mod edges;
mod orient;
mod parts;
mod repair;
mod report;
mod rims;
mod seam;
mod solid;
mod survey;
mod weld;

pub use convex::is_convex;
pub use orient::{NotOrientable, orient_outward};
pub use parts::{Part, depths, parts};
pub use repair::{Repaired, repair};
pub use report::{Report, inspect, signed_volume};
pub use rims::{Rim, rims};
pub use seam::{SEAM, Seams, close_seams};
pub use solid::{NotABody, NotSolid, must_be_body, opposed, solid};
pub use survey::{Hole, Survey, survey};
pub(crate) use weld::kept;
pub use weld::{Removed, clean, weld};

#[cfg(test)]
mod tests;
