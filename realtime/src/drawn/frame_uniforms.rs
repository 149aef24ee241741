//! What a frame shows, and its numbers as the shaders see them.

use crate::drawn::geometry::Geometry;
use crate::drawn::uniforms::{self, Bodies, MAX_BODIES};
use crate::gpu::recorder::Allocator;
use crate::gpu::resources::Resources;
use crate::{Error, Gpu};

use scenes::{Camera, Environment};

/// What a frame shows.
#[derive(Clone, Copy)]
pub(crate) struct Viewed<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) environment: &'a Environment,
    pub(crate) camera: &'a Camera,
    pub(crate) eta_outside: f64,
    pub(crate) resolution_px: [u32; 2],
}

/// Writes the bodies' numbers, and the frame's before layers are counted.
pub(crate) fn upload_numbers(
    allocator: &Allocator<'_>,
    view: &Viewed<'_>,
    resources: &mut Resources,
) -> Result<(), Error> {
    let geometry = view.geometry;
    let uniform = wgpu::BufferUsages::UNIFORM;
    let frame = frame_bytes(view, 0);
    resources.buffer("frame", allocator.filled("frame", &frame, uniform)?);
    let mut list = [uniforms::Body::default(); MAX_BODIES];
    list[..geometry.media.len()].copy_from_slice(&geometry.media);
    // Numbers that no body has.
    list[geometry.media.len()..].iter_mut().for_each(|body| body.solid = u32::MAX - 1);
    let bodies = uniforms::bytes_of(&Bodies { list });
    resources.buffer("bodies", allocator.filled("bodies", &bodies, uniform)?);
    if let Some(bumps) = &geometry.bumps {
        let mut list = [uniforms::Bump::default(); MAX_BODIES];
        list.copy_from_slice(bumps);
        let bytes = uniforms::bytes_of(&uniforms::Bumps { list });
        resources.buffer("bumps", allocator.filled("bumps", &bytes, uniform)?);
    }
    Ok(())
}

/// Writes how many layers there is room for into the frame's numbers.
pub(crate) fn set_layer_capacity(
    gpu: &Gpu,
    view: &Viewed<'_>,
    layer_capacity: u32,
    resources: &Resources,
) {
    let bytes = frame_bytes(view, layer_capacity);
    gpu.queue.write_buffer(resources.stored("frame"), 0, &bytes);
}

fn frame_bytes(view: &Viewed<'_>, layer_capacity: u32) -> Vec<u8> {
    uniforms::bytes_of(&numbers(view, layer_capacity))
}

/// The camera's numbers, as the shaders see them.
pub(crate) fn numbers(view: &Viewed<'_>, layer_capacity: u32) -> uniforms::Frame {
    let Viewed { geometry, camera, eta_outside, resolution_px, .. } = *view;
    let (centre, radius_m) = (geometry.centre, geometry.radius_m);
    uniforms::Frame {
        layer_capacity,
        middle_lc: geometry.middle_lc,
        ..uniforms::Frame::new(camera, resolution_px, centre, radius_m, eta_outside)
    }
}
