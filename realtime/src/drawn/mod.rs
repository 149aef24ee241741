//! What is drawn, moved to the centre of the scene's bodies and narrowed to f32
//! on the way to the GPU.

pub(crate) mod drawables;
pub(crate) mod frame_uniforms;
pub(crate) mod geometry;
pub(crate) mod projection;
pub(crate) mod thickness;
pub(crate) mod uniforms;
