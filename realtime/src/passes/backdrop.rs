//! What stands around the bodies: opaque surfaces, seen directly behind and in
//! front of the bodies, and drawn into a cube of their own for the light that
//! the bodies bend. Source: Seipel & Nivfors, "Efficient rendering of multiple
//! refractions and reflections in natural objects", SIGRAD 2006.
//!
//! The cube shows what is seen from the middle of the bodies, without them. It
//! has the environment's own texels where nothing stands in front.

#[cfg(test)]
mod tests;

use crate::composition::chosen::{camera_piece, no_vector_piece, piece};
use crate::composition::inputs::Order;
use crate::drawn::frame_uniforms::{self, Viewed};
use crate::drawn::uniforms::{self, MAX_BODIES, MAX_LIGHTS};
use crate::gpu::environment_upload as sky;
use crate::gpu::recorder::{Allocator, Recorder};
use crate::gpu::resources::Resources;
use crate::passes::pipelines::{DrawnSurfaces, Maker};
use crate::passes::raster_pass::{Sides, Surfaces, target};
use crate::{Error, Filter, Gpu};
use scenes::Environment;
use wgpu::{BufferUsages, TextureUsages};

/// Texels along a face where the environment has none.
const UNIFORM_CUBE_PX: u32 = 256;
pub(crate) const FACES: [&str; 6] =
    ["cube +X", "cube -X", "cube +Y", "cube -Y", "cube +Z", "cube -Z"];

/// The passes that draw the surroundings.
pub(crate) struct Backdrop {
    /// As the camera sees them.
    pub(crate) background: Surfaces,
    /// As a face of the cube sees them.
    pub(crate) face: Surfaces,
    /// Texels along a face of the cube.
    pub(crate) size_px: u32,
    /// Texels around a face that belong to its neighbours.
    pub(crate) margin: u32,
}

impl Backdrop {
    /// None if nothing opaque is there.
    pub(crate) fn new(order: &Order<'_>) -> Result<Option<Self>, Error> {
        let parts = &order.geometry.opaque;
        if !order.draws_backdrop() {
            return Ok(None);
        }
        let vector = no_vector_piece();
        let drawn = |name, targets, camera, sky_values, parts| {
            let head = [piece!("core/frame.wgsl"), camera];
            let mut surface_head = head.to_vec();
            surface_head.extend([vector.clone(), piece!("surfaces/opaque.wgsl")]);
            let mut sky_head = head.to_vec();
            sky_head.extend([piece!("core/cube.wgsl"), order.environment_piece(false)]);
            Surfaces::new(name, targets, Sides::Opaque, &surface_head, parts)?
                .over_sky(&sky_head, sky_values)
        };
        let light = target("background_light", true, "opaque_light(v)");
        let depth = target("background_depth", false, "depth_of_m(v.p_lc)");
        let camera = camera_piece(order.camera);
        let background =
            drawn("background", vec![light, depth], camera, "sky_light(at.xy), 1e30", parts)?;
        let light = target("face_light", true, "opaque_light(v)");
        let (camera, parts) =
            (piece!("core/camera_perspective.wgsl"), &order.geometry.opaque_in_cube);
        let face = drawn("cube", vec![light], camera, "sky_light(at.xy)", parts)?;
        let size_px = match &order.scene.environment {
            Environment::Uniform(_) => UNIFORM_CUBE_PX,
            Environment::Map(map) => map.cube.size_px,
        };
        let margin = u32::from(order.request.filter == Filter::Manual);
        Ok(Some(Self { background, face, size_px, margin }))
    }

    /// Name of the cube in the shading pass.
    pub(crate) fn cube_name(&self) -> &'static str {
        if self.margin > 0 { "environment_faces" } else { "environment_cube" }
    }

    /// Edge of a face with its margins.
    pub(crate) fn edge_px(&self) -> u32 {
        self.size_px + 2 * self.margin
    }
}

/// The surroundings, ready to be drawn.
pub(crate) struct DrawnBackdrop {
    background: DrawnSurfaces,
    faces: Vec<(DrawnSurfaces, Resources)>,
    resources: Resources,
    /// The cube must be drawn again in every frame.
    changes: bool,
}

impl DrawnBackdrop {
    /// Makes pipelines and memory; what the shading pass reads goes to `shown`.
    pub(crate) fn new(
        gpu: &Gpu,
        allocator: &Allocator<'_>,
        backdrop: &Backdrop,
        view: &Viewed<'_>,
        shown: &mut Resources,
    ) -> Result<Self, Error> {
        let mut resources = surroundings(gpu, allocator, backdrop, view)?;
        shown.share(&mut resources, "frame");
        let parts = &view.geometry.opaque;
        let maker = Maker::new(gpu, allocator, parts, view.resolution_px)?;
        let background = maker.surfaces(&backdrop.background, &mut resources)?;
        for name in ["background_light", "background_depth"] {
            resources.share(shown, name);
        }
        let edge_px = backdrop.edge_px();
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC;
        let format = wgpu::TextureFormat::Rgba32Float;
        let cube = allocator.texture("drawn cube", [edge_px, edge_px, 6], format, usage)?;
        let maker = Maker::new(gpu, allocator, &view.geometry.opaque_in_cube, [edge_px; 2])?;
        let mut faces = Vec::new();
        for (index, name) in FACES.into_iter().enumerate() {
            let mut own = surroundings_shared(&resources);
            let numbers = frame_uniforms::numbers(view, 0);
            let (size_px, margin) = (backdrop.size_px, backdrop.margin);
            let numbers = numbers.of_cube_face(index, view.geometry.middle_lc, size_px, margin);
            let bytes = uniforms::bytes_of(&numbers);
            let uniform = allocator.filled("frame of a face", &bytes, BufferUsages::UNIFORM)?;
            own.buffer("frame", uniform);
            own.layer("face_light", &cube, index as u32);
            let drawn = maker.surfaces(&backdrop.face, &mut own)?.named(name);
            faces.push((drawn, own));
        }
        let dimension = if backdrop.margin > 0 {
            wgpu::TextureViewDimension::D2Array
        } else {
            wgpu::TextureViewDimension::Cube
        };
        shown.texture_as(backdrop.cube_name(), cube, dimension);
        shown.sampler("environment_linear", sky::linear_sampler(gpu));
        Ok(Self { background, faces, resources, changes: view.geometry.changes })
    }

    /// Draws the surroundings; the cube only in the first frame if nothing moves.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, first: bool) {
        self.background.record(recorder, &self.resources);
        if first || self.changes {
            for (face, own) in &self.faces {
                face.record(recorder, own);
            }
        }
    }
}

/// Paints, lights and the environment behind them.
fn surroundings(
    gpu: &Gpu,
    allocator: &Allocator<'_>,
    backdrop: &Backdrop,
    view: &Viewed<'_>,
) -> Result<Resources, Error> {
    let mut resources = Resources::default();
    let geometry = view.geometry;
    let mut numbers = uniforms::Surroundings {
        paints: [uniforms::Paint::default(); MAX_BODIES],
        lights: [uniforms::Light::default(); MAX_LIGHTS],
        light_count: geometry.lights.len() as u32,
    };
    numbers.paints[..geometry.paints.len()].copy_from_slice(&geometry.paints);
    numbers.lights[..geometry.lights.len()].copy_from_slice(&geometry.lights);
    let bytes = uniforms::bytes_of(&numbers);
    let buffer = allocator.filled("surroundings", &bytes, BufferUsages::UNIFORM)?;
    resources.buffer("surroundings", buffer);
    if let Some(behind) = &backdrop.background.behind {
        sky::upload_environment(
            gpu,
            allocator,
            (behind, "sky_fragment"),
            view.environment,
            &mut resources,
        )?;
    }
    Ok(resources)
}

/// The same for another view.
fn surroundings_shared(resources: &Resources) -> Resources {
    let mut own = Resources::default();
    let names = [
        "surroundings",
        "uniform_radiance",
        "environment_faces",
        "environment_cube",
        "environment_linear",
    ];
    for name in names {
        resources.share(&mut own, name);
    }
    own
}
