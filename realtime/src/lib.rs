//! The approximations: published image-space refraction on wgpu.
//!
//! Start with `frame.rs`. A method is one WGSL file and one row of
//! [`method::METHODS`]; passes, buffers and bindings follow from what the WGSL
//! reads. This crate knows nothing of the exact renderer, and only this crate
//! knows wgpu.

mod backdrop;
mod composition;
mod draft;
mod error;
mod frame;
mod geometry;
mod gpu;
mod in_image;
mod interior;
pub mod method;
mod normals;
mod order;
mod outputs;
mod part;
mod parts;
mod peel;
mod pieces;
mod pipelines;
mod plan;
mod raster;
mod readback;
mod recorder;
mod render;
mod request;
mod resources;
mod sky;
mod surfaces;
mod tally;
mod thickness;
mod uniforms;
mod viewed;
mod wgsl;

pub use error::Error;
pub use gpu::{AdapterInfo, Gpu, adapters};
pub use method::{METHODS, Method};
pub use plan::plan;
pub use render::render;
pub use request::{Filter, Request, Timing};
