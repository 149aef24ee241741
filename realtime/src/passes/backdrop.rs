//! What stands around the bodies: opaque surfaces, seen directly behind and in
//! front of the bodies, and drawn into a cube of their own for the light that
//! the bodies bend. Source: Seipel & Nivfors, "Efficient rendering of multiple
//! refractions and reflections in natural objects", SIGRAD 2006.
//!
//! The cube shows what is seen from the middle of the bodies, without them. It
//! has the environment's own texels where nothing stands in front.

#[cfg(test)]
mod tests;

use super::pipelines::ReadyRaster;
use super::raster_pass::{Files, RasterPass, Sides, Target};
use super::{Composed, Listed, Maker, Making, Pass, Ready, Record, Wanted};
use crate::composition::chosen;
use crate::composition::inputs::Inputs;
use crate::drawn::frame_uniforms::{self, FrameUniform, Viewed};
use crate::drawn::geometry::Geometry;
use crate::drawn::uniforms::{self, MAX_BODIES, MAX_LIGHTS};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::environment_upload::{linear_sampler, upload_environment};
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::plan::entries::Entries;
use crate::request::Filter;
use encase::ShaderType;
use scenes::Environment;
use scenes::plan::{Kind, Unsupported};
use wgpu::{BufferUsages, TextureFormat, TextureUsages, TextureViewDimension};

pub(crate) const LISTED: Listed = Listed { compose, absent };

/// Texels along a face where the environment has none.
const UNIFORM_CUBE_PX: u32 = 256;
const FACES: [&str; 6] = ["cube +X", "cube -X", "cube +Y", "cube -Y", "cube +Z", "cube -Z"];
const BACKGROUND: Files =
    Files { targets: "background_targets", analytic: Some("background_analytic") };
const FACE: Files = Files { targets: "face_targets", analytic: Some("face_analytic") };

/// The passes that draw the surroundings.
struct Backdrop {
    /// As the camera sees them.
    background: RasterPass,
    /// As a face of the cube sees them.
    face: RasterPass,
    /// Texels along a face of the cube.
    size_px: u32,
    /// Texels around a face that belong to its neighbours.
    margin: u32,
}

fn compose(inputs: &Inputs<'_>, _: &Wanted<'_>) -> Composed {
    if !inputs.draws_backdrop() {
        return Ok(None);
    }
    let mut choices = inputs.choices.with("vertex_vector", "vertex_none");
    choices.choose("environment", chosen::environment(inputs, false));
    let targets = vec![Target::rgba("background_light", 0), Target::r("background_depth", 1)];
    let (sides, parts) = (Sides::Opaque, &inputs.geometry.opaque);
    let background = RasterPass::new("background", targets, sides, &BACKGROUND, &choices, parts)?
        .over_sky("sky_behind_background", &choices)?;
    choices.choose("camera", "camera_perspective");
    let (targets, parts) = (vec![Target::rgba("face_light", 0)], &inputs.geometry.opaque_in_cube);
    let face = RasterPass::new("cube", targets, sides, &FACE, &choices, parts)?
        .over_sky("sky_behind_face", &choices)?;
    let size_px = match &inputs.scene.environment {
        Environment::Uniform(_) => UNIFORM_CUBE_PX,
        Environment::Map(map) => map.cube.size_px,
    };
    let margin = u32::from(inputs.request.filter == Filter::Manual);
    Ok(Some(Box::new(Backdrop { background, face, size_px, margin })))
}

fn absent(entries: &mut Entries<'_>) {
    if entries.geometry.opaque.is_empty() {
        let (reason, bytes) = ("nothing opaque stands around the bodies", 20 * entries.pixels);
        entries.plan.leave_out(Kind::Pass, "background, six faces of the cube", reason, bytes);
    }
}

impl Backdrop {
    /// Name of the cube in the shading pass.
    fn cube_name(&self) -> &'static str {
        if self.margin > 0 { "environment_faces" } else { "environment_cube" }
    }

    /// Edge of a face with its margins.
    fn edge_px(&self) -> u32 {
        self.size_px + 2 * self.margin
    }

    /// A face of the cube, and its image.
    fn ready_face(
        &self,
        index: usize,
        maker: &Maker<'_>,
        cube: &wgpu::Texture,
        (view, numbers): (&Viewed<'_>, &FrameUniform),
        surroundings: &Outputs,
    ) -> Result<ReadyRaster, Error> {
        let mut own = Outputs::default();
        let (size_px, drawn) = ([self.size_px, self.margin], &view.geometry.opaque_in_cube);
        let numbers = numbers.of_cube_face(index, view.geometry.middle_lc, size_px, drawn);
        let bytes = uniforms::bytes_of(&numbers);
        let uniform = maker.allocator.filled("frame of a face", &bytes, BufferUsages::UNIFORM)?;
        own.buffer("frame", uniform);
        own.layer("face_light", cube, index as u32);
        let (face, _) = maker.raster(&self.face, &own.over(surroundings))?;
        Ok(face.named(FACES[index]))
    }
}

impl Pass for Backdrop {
    fn reads(&self, _: &str) -> bool {
        false
    }

    fn draws_bodies(&self) -> bool {
        false
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        let geometry = entries.geometry;
        entries.buffer("surroundings", uniforms::Surroundings::min_size().get());
        entries.environment();
        entries.corners(&geometry.opaque);
        entries.corners(&geometry.opaque_in_cube);
        let edge = u64::from(self.edge_px());
        entries.buffer("drawn cube", 6 * edge * edge * 16);
        self.background.plan(entries, entries.pixels);
        for _ in FACES {
            entries.buffer("frame of a face", FrameUniform::min_size().get());
            self.face.plan_depth_test(entries, edge * edge);
        }
        // Both sides, for the camera and for every face.
        entries.analytic(&geometry.opaque, 2);
        entries.analytic(&geometry.opaque_in_cube, 2 * FACES.len());
        entries.pass("background");
        let reason = "nothing moves: the cube was drawn before the first frame";
        entries.faces(&FACES, "six faces of the cube", reason);
        if geometry.opaque_in_cube.draws.len() < geometry.opaque.draws.len() {
            entries.plan.unsupported.push(Unsupported {
                what: "an opaque solid in the middle of the bodies".to_owned(),
                instead: "it is seen around the bodies and not through them".to_owned(),
            });
        }
    }

    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let (gpu, allocator) = (making.bodies.gpu, making.bodies.allocator);
        let view = making.view;
        let surroundings = self.surroundings(gpu, allocator, view)?.over(making.before);
        let around = Maker::new(gpu, allocator, &view.geometry.opaque, view.resolution_px)?;
        let (background, mut outputs) = around.raster(&self.background, &surroundings)?;
        let edge_px = self.edge_px();
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC;
        let (size, format) = ([edge_px, edge_px, 6], TextureFormat::Rgba32Float);
        let cube = allocator.texture("drawn cube", size, format, usage)?;
        let in_cube = Maker::new(gpu, allocator, &view.geometry.opaque_in_cube, [edge_px; 2])?;
        let seen = (view, &frame_uniforms::numbers(view, 0));
        let face = |index| self.ready_face(index, &in_cube, &cube, seen, &surroundings);
        let faces = (0..FACES.len()).map(face).collect::<Result<Vec<_>, _>>()?;
        let dimension = match self.margin {
            0 => TextureViewDimension::Cube,
            _ => TextureViewDimension::D2Array,
        };
        outputs.texture_as(self.cube_name(), cube, dimension);
        outputs.sampler("environment_linear", linear_sampler(gpu));
        let changes = view.geometry.changes;
        Ok(Ready::new(ReadyBackdrop { background, faces, changes }, outputs))
    }
}

impl Backdrop {
    /// Paints, lights and the environment behind them.
    fn surroundings(
        &self,
        gpu: &Gpu,
        allocator: &Allocator<'_>,
        view: &Viewed<'_>,
    ) -> Result<Outputs, Error> {
        let bytes = surroundings_bytes(view.geometry);
        let mut outputs = match &self.background.behind {
            Some(behind) => {
                let reader = (behind, "sky_fragment");
                upload_environment(gpu, allocator, reader, view.environment)?
            }
            None => Outputs::default(),
        };
        let buffer = allocator.filled("surroundings", &bytes, BufferUsages::UNIFORM)?;
        outputs.buffer("surroundings", buffer);
        Ok(outputs)
    }
}

/// Paints and lights, as the shaders see them.
pub(super) fn surroundings_bytes(geometry: &Geometry) -> Vec<u8> {
    let mut numbers = uniforms::Surroundings {
        paints: [uniforms::Paint::default(); MAX_BODIES],
        lights: [uniforms::Light::default(); MAX_LIGHTS],
        light_count: geometry.lights.len() as u32,
    };
    numbers.paints[..geometry.paints.len()].copy_from_slice(&geometry.paints);
    numbers.lights[..geometry.lights.len()].copy_from_slice(&geometry.lights);
    uniforms::bytes_of(&numbers)
}

/// The surroundings, ready to be drawn.
struct ReadyBackdrop {
    background: ReadyRaster,
    faces: Vec<ReadyRaster>,
    /// The cube must be drawn again in every frame.
    changes: bool,
}

impl Record for ReadyBackdrop {
    /// The cube only in the first frame if nothing moves.
    fn record(&self, recorder: &mut Recorder<'_>, first: bool) {
        self.background.record(recorder);
        if first || self.changes {
            self.faces.iter().for_each(|face| face.record(recorder));
        }
    }
}
