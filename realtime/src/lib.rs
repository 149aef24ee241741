//! The approximations: published image-space refraction on wgpu.
//!
//! Start with `frame.rs`. A method is one WGSL file and one row with its parameters
//! in [`methods`]; passes, buffers and bindings follow from what the WGSL reads. A
//! pass is a file in `passes` and one row in `frame.rs`. This crate knows nothing of the exact renderer, and only this crate
//! knows wgpu.

mod asked;
mod composition;
mod drawing;
mod drawn;
mod error;
mod frame;
mod frames;
mod gpu;
pub mod methods;
mod passes;
mod plan;
mod planned;
mod readout;
mod render;
mod request;
mod wgsl;

pub use error::Error;
pub use gpu::{AdapterInfo, Gpu, adapters, noise};
pub use methods::{METHODS, Method};
pub use planned::{plan, plan_on};
pub use render::render;
pub use request::{Filter, Keep, Request, Timing};
