//! What a frame shows, and its numbers as the shaders see them.

use crate::drawn::clip_planes;
use crate::drawn::drawables::Drawables;
use crate::drawn::geometry::Geometry;
use crate::drawn::uniforms::{self, Bodies, MAX_BODIES};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::resources::Outputs;
use encase::ShaderType;
use glam::{DMat4, DVec2, DVec3, IVec3, Mat4, Vec2, Vec3, Vec4};

use scenes::{Camera, Environment, Projection};

/// What a frame shows.
#[derive(Clone, Copy)]
pub(crate) struct Viewed<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) environment: &'a Environment,
    pub(crate) camera: &'a Camera,
    pub(crate) eta_outside: f64,
    pub(crate) resolution_px: [u32; 2],
    /// From the pixels' centres to the positions in them that are drawn, as parts of
    /// the image's width and height.
    pub(crate) shift: DVec2,
}

/// Mirrors `Frame` in frame.wgsl.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct FrameUniform {
    pub(crate) clip_from_lc: Mat4,
    pub(crate) eye_lc: Vec3,
    pub(crate) right_ws: Vec3,
    pub(crate) up_ws: Vec3,
    pub(crate) forward_ws: Vec3,
    pub(crate) half_extent: Vec2,
    pub(crate) resolution_px: Vec2,
    pub(crate) shift_px: Vec2,
    pub(crate) eta_outside: f32,
    pub(crate) radius_m: f32,
    pub(crate) layer_capacity: u32,
    pub(crate) middle_lc: Vec3,
    pub(crate) ball_lc: Vec3,
    pub(crate) waist_lc: Vec3,
    pub(crate) waist_depth_m: f32,
    pub(crate) unit_m: f32,
    pub(crate) waist_fixed: IVec3,
    pub(crate) across_fixed: IVec3,
    pub(crate) across_rest: Vec3,
    pub(crate) down_fixed: IVec3,
    pub(crate) down_rest: Vec3,
}

/// Writes the bodies' numbers, and the frame's before layers are counted.
pub(crate) fn upload_numbers(
    allocator: &Allocator<'_>,
    view: &Viewed<'_>,
) -> Result<Outputs, Error> {
    let mut outputs = Outputs::default();
    let geometry = view.geometry;
    let uniform = wgpu::BufferUsages::UNIFORM;
    let frame = frame_bytes(view, 0);
    outputs.buffer("frame", allocator.filled("frame", &frame, uniform)?);
    let mut list = [uniforms::Body::default(); MAX_BODIES];
    list[..geometry.media.len()].copy_from_slice(&geometry.media);
    // Numbers that no body has.
    list[geometry.media.len()..].iter_mut().for_each(|body| body.solid = u32::MAX - 1);
    let bodies = uniforms::bytes_of(&Bodies { list });
    outputs.buffer("bodies", allocator.filled("bodies", &bodies, uniform)?);
    if let Some(bumps) = &geometry.bumps {
        let mut list = [uniforms::Bump::default(); MAX_BODIES];
        list.copy_from_slice(bumps);
        let bytes = uniforms::bytes_of(&uniforms::Bumps { list });
        outputs.buffer("bumps", allocator.filled("bumps", &bytes, uniform)?);
    }
    Ok(outputs)
}

/// Writes the numbers of a view again: its shift may be another, and how many
/// layers there is room for.
pub(crate) fn write(gpu: &Gpu, buffer: &wgpu::Buffer, view: &Viewed<'_>, layer_capacity: u32) {
    gpu.queue.write_buffer(buffer, 0, &frame_bytes(view, layer_capacity));
}

fn frame_bytes(view: &Viewed<'_>, layer_capacity: u32) -> Vec<u8> {
    uniforms::bytes_of(&numbers(view, layer_capacity))
}

/// The camera's numbers, as the shaders see them.
pub(crate) fn numbers(view: &Viewed<'_>, layer_capacity: u32) -> FrameUniform {
    let Viewed { geometry, camera, eta_outside, resolution_px, shift, .. } = *view;
    let extent = geometry.extent;
    let basis = camera.basis();
    let waist = Waist::new(view);
    // The image moves against the pixels by as much as their positions move in it.
    let shifted = DMat4::from_translation(DVec3::new(-2.0 * shift.x, 2.0 * shift.y, 0.0));
    let clip_from_lc = shifted
        * clip_planes::clip_from_world(camera, &geometry.drawn())
        * DMat4::from_translation(extent.origin);
    FrameUniform {
        clip_from_lc: clip_from_lc.as_mat4(),
        eye_lc: (camera.eye - extent.origin).as_vec3(),
        right_ws: basis.right.as_vec3(),
        up_ws: basis.up.as_vec3(),
        forward_ws: basis.forward.as_vec3(),
        half_extent: camera.half_extent().as_vec2(),
        resolution_px: Vec2::from_array(resolution_px.map(|n| n as f32)),
        eta_outside: eta_outside as f32,
        radius_m: extent.radius_m as f32,
        layer_capacity,
        middle_lc: geometry.middle_lc,
        ball_lc: (extent.middle - extent.origin).as_vec3(),
        shift_px: (shift * DVec2::from_array(resolution_px.map(f64::from))).as_vec2(),
        waist_lc: waist.middle.as_vec3(),
        waist_depth_m: waist.depth_m as f32,
        unit_m: waist.unit_m as f32,
        waist_fixed: waist.corner.round().as_ivec3(),
        across_fixed: waist.across.round().as_ivec3(),
        across_rest: (waist.across - waist.across.round()).as_vec3(),
        down_fixed: waist.down.round().as_ivec3(),
        down_rest: (waist.down - waist.down.round()).as_vec3(),
    }
}

/// The plane across the view where the bodies are. Places on it in units hold what of the
/// pixels' rays 32 bits of float cannot.
struct Waist {
    unit_m: f64,
    depth_m: f64,
    /// Where the viewing axis meets it, local space.
    middle: DVec3,
    /// Upper left corner of the image, and half a pixel across and down, units.
    corner: DVec3,
    across: DVec3,
    down: DVec3,
}

impl Waist {
    fn new(view: &Viewed<'_>) -> Self {
        let Viewed { geometry, camera, resolution_px, shift, .. } = *view;
        let (origin, basis) = (geometry.extent.origin, camera.basis());
        let depth_m = (origin - camera.eye).dot(basis.forward);
        let unit_m = 2.0_f64.powf(geometry.extent.reach_m.log2().ceil() - 29.0);
        let reach_m = match camera.projection {
            Projection::Perspective { .. } => depth_m,
            Projection::Orthographic { .. } => 1.0,
        };
        let half = camera.half_extent() * reach_m / unit_m;
        let middle = camera.eye - origin + depth_m * basis.forward;
        let shifted = 2.0 * shift - 1.0;
        let from_middle = basis.right * half.x * shifted.x - basis.up * half.y * shifted.y;
        Self {
            unit_m,
            depth_m,
            middle,
            corner: middle / unit_m + from_middle,
            across: basis.right * half.x / f64::from(resolution_px[0]),
            down: -basis.up * half.y / f64::from(resolution_px[1]),
        }
    }
}

impl FrameUniform {
    /// One face of a cube about a point (local space), seen at a right angle
    /// and `margin` texels more on every side. Rows run down the face and
    /// columns to its right, as WebGPU numbers them: a mirrored camera. `drawn`: what
    /// it looks at.
    pub(crate) fn of_cube_face(
        &self,
        face: usize,
        eye_lc: Vec3,
        [size_px, margin]: [u32; 2],
        drawn: &Drawables,
    ) -> Self {
        const FACES: [[Vec3; 3]; 6] = [
            [Vec3::NEG_Z, Vec3::Y, Vec3::X],
            [Vec3::Z, Vec3::Y, Vec3::NEG_X],
            [Vec3::X, Vec3::NEG_Z, Vec3::Y],
            [Vec3::X, Vec3::Z, Vec3::NEG_Y],
            [Vec3::X, Vec3::Y, Vec3::Z],
            [Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z],
        ];
        let [right, up, forward] = FACES[face];
        let edge_px = (size_px + 2 * margin) as f32;
        let extent = edge_px / size_px as f32;
        let eye = drawn.centre + eye_lc.as_dvec3();
        let reach = f64::from(extent).hypot(extent.into());
        let view = |axis: Vec3| axis.extend(-axis.dot(eye_lc));
        let z = Vec4::W * clip_planes::near_m(eye, reach, &[drawn]) as f32;
        let rows = [view(right) / extent, view(up) / extent, z, view(forward)];
        Self {
            clip_from_lc: Mat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose(),
            eye_lc,
            right_ws: right,
            up_ws: up,
            forward_ws: forward,
            half_extent: Vec2::splat(extent),
            resolution_px: Vec2::splat(edge_px),
            shift_px: Vec2::ZERO,
            ..self.clone()
        }
    }
}
