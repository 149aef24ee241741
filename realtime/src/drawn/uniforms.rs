//! Numbers as the shaders see them. This folder is where f64 becomes f32, after
//! everything has been moved to the centre of the scene's bodies; the only other
//! place is the environment's radiance, which has no position.

use encase::{ShaderType, StorageBuffer, UniformBuffer};
use glam::{DAffine3, DMat4, DVec3, Mat4, Vec3, Vec4};
use scenes::Surface;

/// Most bodies a scene may show.
pub(crate) const MAX_BODIES: usize = 16;

/// Mirrors `Body` in frame.wgsl.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct Body {
    pub(crate) eta: f32,
    pub(crate) solid: u32,
    pub(crate) absorption_per_m: Vec3,
    pub(crate) eta_channels: Vec3,
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

/// Most lights a scene may have.
pub(crate) const MAX_LIGHTS: usize = 16;

/// Mirrors `Bump` in bump.wgsl.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct Bump {
    pub(crate) object_from_lc: Mat4,
    pub(crate) lc_from_object: Mat4,
    pub(crate) amplitude: f32,
    pub(crate) frequency_per_m: f32,
    pub(crate) seed: u32,
}

/// Mirrors `array<Bump, 16>` in bump.wgsl.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct Bumps {
    pub(crate) list: [Bump; MAX_BODIES],
}

/// Mirrors `Paint` in opaque.wgsl.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct Paint {
    pub(crate) object_from_lc: Mat4,
    pub(crate) first: Vec3,
    pub(crate) size_m: f32,
    pub(crate) second: Vec3,
    pub(crate) lit: u32,
}

/// Mirrors `Light` in opaque.wgsl.
#[derive(Clone, Copy, Debug, Default, ShaderType)]
pub(crate) struct Light {
    pub(crate) place: Vec4,
    pub(crate) colour: Vec3,
}

/// Mirrors `Surroundings` in opaque.wgsl.
#[derive(Clone, Debug, ShaderType)]
pub(crate) struct Surroundings {
    pub(crate) paints: [Paint; MAX_BODIES],
    pub(crate) lights: [Light; MAX_LIGHTS],
    pub(crate) light_count: u32,
}

/// Mirrors `Interior` in interior.wgsl.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Interior {
    pub(crate) towards_light_ws: Vec3,
    pub(crate) size_m: f32,
}

impl Bump {
    pub(crate) fn new(
        bump: &scenes::scene::Bump,
        world_from_object: &DAffine3,
        centre: DVec3,
    ) -> Self {
        let object_from_lc = object_from_lc(world_from_object, centre);
        Self {
            object_from_lc: object_from_lc.as_mat4(),
            lc_from_object: object_from_lc.inverse().as_mat4(),
            amplitude: bump.amplitude as f32,
            frequency_per_m: bump.frequency_per_m as f32,
            seed: scenes::noise::seed32(bump.seed),
        }
    }
}

impl Paint {
    pub(crate) fn new(surface: &Surface, world_from_object: &DAffine3, centre: DVec3) -> Self {
        let (paint, lit) = match surface {
            Surface::Unlit { radiance } => (radiance, 0),
            Surface::Lambert { albedo } => (albedo, 1),
            Surface::Dielectric { .. } => return Self::default(),
        };
        let ([first, second], size_m) = match paint {
            scenes::scene::Paint::Constant(colour) => ([*colour; 2], 1.0),
            scenes::scene::Paint::Checker { colours, size_m } => (*colours, *size_m),
        };
        Self {
            object_from_lc: object_from_lc(world_from_object, centre).as_mat4(),
            first: first.as_vec3(),
            size_m: size_m as f32,
            second: second.as_vec3(),
            lit,
        }
    }
}

impl Light {
    /// `place`: position in local space and 1, or direction of travel and 0.
    pub(crate) fn new(light: &scenes::scene::Light, centre: DVec3) -> Self {
        match light {
            scenes::scene::Light::Point { position_m, intensity } => Self {
                place: (*position_m - centre).as_vec3().extend(1.0),
                colour: intensity.as_vec3(),
            },
            scenes::scene::Light::Directional { direction, irradiance } => {
                Self { place: direction.as_vec3().extend(0.0), colour: irradiance.as_vec3() }
            }
        }
    }
}

fn object_from_lc(world_from_object: &DAffine3, centre: DVec3) -> DMat4 {
    DMat4::from((DAffine3::from_translation(-centre) * *world_from_object).inverse())
}

/// The bytes of a uniform.
pub(crate) fn bytes_of<T: ShaderType + encase::internal::WriteInto>(value: &T) -> Vec<u8> {
    let mut buffer = UniformBuffer::new(Vec::new());
    // Writing into a Vec cannot fail: it grows.
    buffer.write(value).expect("a Vec takes any number of bytes");
    buffer.into_inner()
}

/// The bytes of a list in storage.
pub(crate) fn stored_bytes_of<T: ShaderType + encase::internal::WriteInto>(value: &T) -> Vec<u8> {
    let mut buffer = StorageBuffer::new(Vec::new());
    buffer.write(value).expect("a Vec takes any number of bytes");
    buffer.into_inner()
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
    use crate::drawn::frame_uniforms::FrameUniform;
    use crate::drawn::ray_tree::RayAnalytic;

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

    const RUST: &str = concat!(
        include_str!("uniforms.rs"),
        include_str!("frame_uniforms.rs"),
        include_str!("ray_tree.rs")
    );
    const FRAME: &str = include_str!("../shaders/core/frame.wgsl");

    #[test]
    fn uniforms_have_the_same_names_order_and_size_in_rust_and_in_wgsl() {
        assert_eq!(in_rust!(FrameUniform), in_wgsl(FRAME, "Frame"));
        assert_eq!(in_rust!(Body), in_wgsl(FRAME, "Body"));
        let before_bindings = |file: &str| {
            let text = crate::wgsl::named(file).unwrap().text;
            text[..text.find("@group").unwrap()].to_owned()
        };
        let analytic = before_bindings("raster_analytic");
        assert_eq!(in_rust!(Analytic), in_wgsl(&analytic, "Analytic"));
        let ray_analytic = before_bindings("ray_analytic");
        assert_eq!(in_rust!(RayAnalytic), in_wgsl(&ray_analytic, "RayAnalytic"));
        assert_eq!(in_rust!(Bump), in_wgsl(&before_bindings("bump"), "Bump"));
        assert_eq!(in_rust!(Interior), in_wgsl(&before_bindings("interior"), "Interior"));
        let opaque = before_bindings("opaque");
        assert_eq!(in_rust!(Paint), in_wgsl(&opaque, "Paint"));
        assert_eq!(in_rust!(Light), in_wgsl(&opaque, "Light"));
        assert_eq!(in_rust!(Surroundings), in_wgsl(&opaque, "Surroundings"));
    }

    #[test]
    fn exchanged_members_are_noticed() {
        let exchanged = FRAME.replace("up_ws", "was_up").replace("right_ws", "up_ws");
        let exchanged = exchanged.replace("was_up", "right_ws");
        assert_ne!(in_rust!(FrameUniform), in_wgsl(&exchanged, "Frame"));
    }
}
