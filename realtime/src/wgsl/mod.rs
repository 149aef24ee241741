//! WGSL: files, what their heads say, how they become a shader, and what of it is
//! really used.

mod bindings;
mod composer;
mod files;
mod shader;
mod source;
mod told;

pub(crate) use composer::{Choices, named};
#[cfg(test)]
pub(crate) use files::FILES;
pub(crate) use shader::Shader;
pub(crate) use source::{Head, Source};
