//! The normals of the bodies' far sides in a cube about their middle, for
//! `normal-cube`. Drawn once unless something moves or deforms.

use super::pipelines::ReadyRaster;
use super::raster_pass::{Files, RasterPass, Sides, Target};
use super::{Composed, Listed, Making, Pass, Ready, Record, Wanted};
use crate::composition::inputs::Inputs;
use crate::drawn::frame_uniforms::FrameUniform;
use crate::drawn::{frame_uniforms, uniforms};
use crate::error::Error;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::plan::entries::Entries;
use encase::ShaderType;
use wgpu::{BufferUsages, TextureFormat, TextureUsages, TextureViewDimension};

pub(crate) const LISTED: Listed = Listed { compose, absent: |_| () };

/// Texels along a face.
const SIZE_PX: u32 = 256;
const FACES: [&str; 6] =
    ["normals +X", "normals -X", "normals +Y", "normals -Y", "normals +Z", "normals -Z"];
const FILES: Files =
    Files { targets: "normal_face_targets", analytic: Some("normal_face_analytic") };
/// What shading reads.
const CUBE: &str = "normal_faces";

/// One face's pass: the farthest surface in each direction, whichever side it shows.
struct NormalCube(RasterPass);

fn compose(inputs: &Inputs<'_>, wanted: &Wanted<'_>) -> Composed {
    if !wanted.reads(CUBE) {
        return Ok(None);
    }
    let choices = inputs.choices.with("camera", "camera_perspective");
    let (targets, bodies) = (vec![Target::rgba("normal_face", 0)], &inputs.geometry.bodies);
    let pass = RasterPass::new("normals", targets, Sides::Outermost, &FILES, &choices, bodies)?;
    Ok(Some(Box::new(NormalCube(pass))))
}

impl Pass for NormalCube {
    fn reads(&self, global: &str) -> bool {
        self.0.reads(global)
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        let pixels = u64::from(SIZE_PX).pow(2);
        entries.buffer(CUBE, 6 * pixels * 16);
        for _ in FACES {
            entries.buffer("frame of a face", FrameUniform::min_size().get());
            self.0.plan_depth_test(entries, pixels);
        }
        // Both sides, for every face.
        entries.analytic_bodies(2 * FACES.len());
        let reason = "nothing moves: the normals were drawn before the first frame";
        entries.faces(&FACES, "six faces of normals", reason);
    }

    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let maker = making.bodies.clone().resized([SIZE_PX; 2]);
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let (size, format) = ([SIZE_PX, SIZE_PX, 6], TextureFormat::Rgba32Float);
        let cube = maker.allocator.texture(CUBE, size, format, usage)?;
        let geometry = making.view.geometry;
        let numbers = frame_uniforms::numbers(making.view, 0);
        let mut faces = Vec::new();
        for (index, name) in FACES.into_iter().enumerate() {
            let (size_px, drawn) = ([SIZE_PX, 0], &geometry.bodies);
            let face = numbers.of_cube_face(index, geometry.middle_lc, size_px, drawn);
            let bytes = uniforms::bytes_of(&face);
            let uniform = BufferUsages::UNIFORM;
            let mut own = Outputs::default();
            own.buffer("frame", maker.allocator.filled("frame of a face", &bytes, uniform)?);
            own.layer("normal_face", &cube, index as u32);
            let (face, _) = maker.raster(&self.0, &own.over(making.before))?;
            faces.push(face.named(name));
        }
        let mut outputs = Outputs::default();
        outputs.texture_as(CUBE, cube, TextureViewDimension::D2Array);
        Ok(Ready::new(ReadyNormalCube { faces, changes: geometry.changes }, outputs))
    }
}

/// The faces, ready to be drawn.
struct ReadyNormalCube {
    faces: Vec<ReadyRaster>,
    changes: bool,
}

impl Record for ReadyNormalCube {
    /// In the first frame only if nothing moves.
    fn record(&self, recorder: &mut Recorder<'_>, first: bool) {
        if first || self.changes {
            self.faces.iter().for_each(|face| face.record(recorder));
        }
    }
}
