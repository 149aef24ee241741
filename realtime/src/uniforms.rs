//! Numbers as the shaders see them. This and `geometry` are where f64 becomes
//! f32, after everything has been moved to the centre of the scene's bodies.

use encase::{ShaderType, UniformBuffer};
use glam::{DAffine3, DMat4, DVec3, Mat4, Vec2, Vec3, Vec4};
use scenes::Camera;

/// Most bodies a scene may show.
pub(crate) const MAX_BODIES: usize = 16;

/// Mirrors `Frame` in frame.wgsl.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct Frame {
    pub(crate) clip_from_lc: Mat4,
    pub(crate) eye_lc: Vec3,
    pub(crate) right_ws: Vec3,
    pub(crate) up_ws: Vec3,
    pub(crate) forward_ws: Vec3,
    pub(crate) half_extent: Vec2,
    pub(crate) resolution_px: Vec2,
    pub(crate) eta_outside: f32,
    pub(crate) radius_m: f32,
    pub(crate) layer_capacity: u32,
}

/// Mirrors `Body` in frame.wgsl.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct Body {
    pub(crate) eta: f32,
    pub(crate) solid: u32,
    pub(crate) absorption_per_m: Vec3,
}

/// Mirrors `array<Body, 16>` in frame.wgsl.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct Bodies {
    pub(crate) list: [Body; MAX_BODIES],
}

/// Mirrors `Analytic` in raster_analytic.wgsl.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct Analytic {
    pub(crate) object_from_lc: Mat4,
    pub(crate) lc_from_object: Mat4,
    pub(crate) size_m: Vec4,
    pub(crate) body: f32,
    pub(crate) far_side: u32,
}

/// The bytes of a uniform.
pub(crate) fn bytes_of<T: ShaderType + encase::internal::WriteInto>(value: &T) -> Vec<u8> {
    let mut buffer = UniformBuffer::new(Vec::new());
    // Writing into a Vec cannot fail: it grows.
    buffer.write(value).expect("a Vec takes any number of bytes");
    buffer.into_inner()
}

impl Frame {
    /// The camera at a resolution, seen from `centre` (world space, metres).
    pub(crate) fn new(
        camera: &Camera,
        resolution_px: [u32; 2],
        centre: DVec3,
        radius_m: f64,
        eta_outside: f64,
    ) -> Self {
        let basis = camera.basis();
        let middle_m = (centre - camera.eye).dot(basis.forward);
        // Planes fitted to the bodies; never behind the eye.
        let near_m = (middle_m - 1.001 * radius_m).max(1e-3 * radius_m);
        let far_m = (middle_m + 1.001 * radius_m).max(2.0 * near_m);
        let clip_from_lc = camera.clip_from_view(near_m, far_m)
            * camera.view_from_world()
            * DMat4::from_translation(centre);
        Self {
            clip_from_lc: clip_from_lc.as_mat4(),
            eye_lc: (camera.eye - centre).as_vec3(),
            right_ws: basis.right.as_vec3(),
            up_ws: basis.up.as_vec3(),
            forward_ws: basis.forward.as_vec3(),
            half_extent: camera.half_extent().as_vec2(),
            resolution_px: Vec2::from_array(resolution_px.map(|n| n as f32)),
            eta_outside: eta_outside as f32,
            radius_m: radius_m as f32,
            layer_capacity: 0,
        }
    }
}

impl Analytic {
    pub(crate) fn new(
        world_from_object: &DAffine3,
        centre: DVec3,
        size_m: Vec4,
        body: u32,
        far: bool,
    ) -> Self {
        let lc_from_object = DAffine3::from_translation(-centre) * *world_from_object;
        Self {
            object_from_lc: DMat4::from(lc_from_object.inverse()).as_mat4(),
            lc_from_object: DMat4::from(lc_from_object).as_mat4(),
            size_m,
            body: body as f32,
            far_side: u32::from(far),
        }
    }
}
