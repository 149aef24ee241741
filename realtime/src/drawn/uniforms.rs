//! Numbers as the shaders see them. This and `geometry` are where f64 becomes
//! f32, after everything has been moved to the centre of the scene's bodies.

use encase::{ShaderType, UniformBuffer};
use glam::{DAffine3, DMat4, DVec3, Mat4, Vec2, Vec3, Vec4};
use scenes::{Camera, Surface};

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
    pub(crate) middle_lc: Vec3,
}

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
            middle_lc: Vec3::ZERO,
        }
    }
}

impl Frame {
    /// One face of a cube about a point (local space), seen at a right angle
    /// and `margin` texels more on every side. Rows run down the face and
    /// columns to its right, as WebGPU numbers them: a mirrored camera.
    pub(crate) fn of_cube_face(
        &self,
        face: usize,
        eye_lc: Vec3,
        size_px: u32,
        margin: u32,
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
        let (near_m, far_m) = (1e-3 * self.radius_m, 4.0 * self.radius_m);
        let depth = far_m / (far_m - near_m);
        let view = |axis: Vec3| axis.extend(-axis.dot(eye_lc));
        let z = view(forward) * depth - Vec4::W * near_m * depth;
        let rows = [view(right) / extent, view(up) / extent, z, view(forward)];
        Self {
            clip_from_lc: Mat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose(),
            eye_lc,
            right_ws: right,
            up_ws: up,
            forward_ws: forward,
            half_extent: Vec2::splat(extent),
            resolution_px: Vec2::splat(edge_px),
            ..self.clone()
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
    const FRAME: &str = include_str!("../shaders/core/frame.wgsl");

    #[test]
    fn uniforms_have_the_same_names_order_and_size_in_rust_and_in_wgsl() {
        assert_eq!(in_rust!(Frame), in_wgsl(FRAME, "Frame"));
        assert_eq!(in_rust!(Body), in_wgsl(FRAME, "Body"));
        let analytic = include_str!("../shaders/raster/raster_analytic.wgsl");
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
