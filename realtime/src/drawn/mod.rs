//! What is drawn, moved near to what the eye sees of the bodies and narrowed to f32
//! on the way to the GPU.

pub(crate) mod clip_planes;
pub(crate) mod drawables;
pub(crate) mod extent;
pub(crate) mod frame_uniforms;
pub(crate) mod geometry;
pub(crate) mod projection;
pub(crate) mod ray_refit;
pub(crate) mod ray_tree;
pub(crate) mod thickness;
pub(crate) mod uniforms;
