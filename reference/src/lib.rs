//! The exact answer: a CPU ray tracer in f64 that follows every refraction and
//! reflection.
//!
//! Start with [`render`] (module `frame`), which is the image in execution
//! order. No ray is lost at an edge, no epsilon moves an origin, and what is
//! not followed is reported.

mod caustics;
mod error;
mod frame;
mod geometry;
mod image;
mod optics;
mod receiver;
mod request;
mod sampling;
mod transport;
mod world;

pub use caustics::{CausticsRequest, caustics};
pub use error::Error;
pub use frame::{render, render_watched};
pub use geometry::bvh::{Hit, Instructions, Triangles};
pub use image::layers::LAYERS;
pub use image::plan::plan;
pub use image::run::Watch;
pub use optics::interface;
pub use receiver::map::{Balance, CausticMap};
pub use request::{
    Disturbance, EnvironmentLookup, Estimator, FEWEST_WAVELENGTHS, Fresnel, Keep, Level, Paths,
    Positions, Request, Restriction, Spectrum,
};
