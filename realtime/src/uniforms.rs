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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot read the shader must fail")]
    use super::*;

    type Layout = (Vec<(String, u32)>, u32);

    /// Name and offset of each member, and the size, as naga lays them out.
    fn in_wgsl(text: &str, name: &str) -> Layout {
        let module = naga::front::wgsl::parse_str(text).unwrap();
        let mut types = module.types.iter();
        let (_, found) = types.find(|(_, ty)| ty.name.as_deref() == Some(name)).unwrap();
        let naga::TypeInner::Struct { members, span } = &found.inner else { panic!("{name}") };
        (members.iter().map(|m| (m.name.clone().unwrap(), m.offset)).collect(), *span)
    }

    /// Names of a Rust structure's members, in their order of declaration.
    fn names(structure: &str) -> Vec<String> {
        let body = RUST.split(&format!("struct {structure} {{")).nth(1).unwrap();
        let members = body.split('}').next().unwrap().split("pub(crate) ").skip(1);
        members.map(|member| member.split(':').next().unwrap().to_owned()).collect()
    }

    /// The same as encase lays them out.
    macro_rules! in_rust {
        ($structure:ident) => {{
            let offset = |index: usize| $structure::METADATA.offset(index) as u32;
            let named = names(stringify!($structure)).into_iter().enumerate();
            let members = named.map(|(index, name)| (name, offset(index))).collect();
            (members, $structure::min_size().get() as u32)
        }};
    }

    const RUST: &str = include_str!("uniforms.rs");
    const FRAME: &str = include_str!("shaders/frame.wgsl");

    #[test]
    fn uniforms_have_the_same_names_order_and_size_in_rust_and_in_wgsl() {
        assert_eq!(in_rust!(Frame), in_wgsl(FRAME, "Frame"));
        assert_eq!(in_rust!(Body), in_wgsl(FRAME, "Body"));
        let analytic = include_str!("shaders/raster_analytic.wgsl");
        let analytic = &analytic[..analytic.find("@group").unwrap()];
        assert_eq!(in_rust!(Analytic), in_wgsl(analytic, "Analytic"));
    }

    #[test]
    fn exchanged_members_are_noticed() {
        let exchanged = FRAME.replace("up_ws", "was_up").replace("right_ws", "up_ws");
        let exchanged = exchanged.replace("was_up", "right_ws");
        assert_ne!(in_rust!(Frame), in_wgsl(&exchanged, "Frame"));
    }
}
