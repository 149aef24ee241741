//! The exact answer: a CPU ray tracer in f64 that follows every refraction and
//! reflection.
//!
//! Start with [`render`] (module `frame`), which is the image in execution
//! order. No ray is lost at an edge, no epsilon moves an origin, and what is
//! not followed is reported.

mod analytic;
mod bend;
mod branches;
mod caustic_map;
mod caustics;
mod chain;
mod convex;
mod crossing;
mod edge;
mod error;
mod face;
mod flight;
mod frame;
pub mod interface;
mod job;
mod lattice;
mod layers;
mod light;
mod line;
mod media;
mod normals;
mod opaque;
mod optics;
mod placed;
mod plan;
mod polarised;
mod policy;
mod request;
mod sampling;
mod settle;
mod soup;
mod spectrum;
mod stokes;
mod topology;
mod tracer;
mod trapped;
mod triangle;
mod triangles;
#[cfg(test)]
mod watertight;
mod wide;
mod world;

pub use caustic_map::{Balance, CausticMap};
pub use caustics::{CausticsRequest, caustics};
pub use error::Error;
pub use frame::{render, render_watched};
pub use job::Watch;
pub use layers::LAYERS;
pub use plan::plan;
pub use request::{
    EnvironmentLookup, Estimator, FEWEST_WAVELENGTHS, Fresnel, Level, Paths, Positions, Request,
    Restriction, Spectrum,
};
pub use triangles::{Hit, Triangles};
pub use wide::Instructions;
