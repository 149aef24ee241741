//! The approximations: published image-space refraction on wgpu.
//!
//! Start with `frame.rs`. A method is one WGSL file and one row of
//! [`methods::METHODS`]; passes, buffers and bindings follow from what the WGSL
//! reads. This crate knows nothing of the exact renderer, and only this crate
//! knows wgpu.

mod composition;
mod drawn;
mod error;
mod frame;
mod frames;
mod gpu;
pub mod methods;
mod passes;
mod plan;
mod render;
mod request;
mod wgsl;

pub use error::Error;
pub use gpu::{AdapterInfo, Gpu, adapters};
pub use methods::{METHODS, Method};
pub use plan::plan;
pub use render::render;
pub use request::{Filter, Keep, Request, Timing};
