//! WGSL put together and read back.

mod shader;

pub(crate) use shader::{Piece, Shader};
