//! The pieces of work of a study, named by their content.
//!
//! A job's id is a hash of everything that its result depends on: the request,
//! the scene and every file it refers to, and the sources of the renderer. The
//! same id therefore means the same result, on any day and in any process.

mod approximation;
mod exact;
mod made;

pub use approximation::Approximation;
pub use exact::{Exact, is_disjoint};
pub use made::Made;
