//! The normals of the bodies' far sides in a cube about their middle, for
//! `normal-cube`. Drawn once unless something moves or deforms.

use crate::Error;
use crate::composition::chosen::piece;
use crate::composition::inputs::Order;
use crate::drawn::drawables::Parts;
use crate::drawn::frame_uniforms::{self, Viewed};
use crate::drawn::uniforms;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Resources;
use crate::passes::pipelines::{DrawnSurfaces, Maker};
use crate::passes::raster_pass::{Sides, Surfaces, target};
use wgpu::{BufferUsages, TextureUsages};

/// Texels along a face.
pub(crate) const SIZE_PX: u32 = 256;
pub(crate) const FACES: [&str; 6] =
    ["normals +X", "normals -X", "normals +Y", "normals -Y", "normals +Z", "normals -Z"];

/// One face's pass: the farthest surface in each direction, whichever side it shows.
pub(crate) fn composed(order: &Order<'_>, bodies: &Parts) -> Result<Surfaces, Error> {
    let head = order.raster_head_of(piece!("core/camera_perspective.wgsl"));
    let value = "vec4f(surface_normal_ws(v), distance(v.p_lc, frame.middle_lc))";
    let normal = vec![target("normal_face", true, value)];
    Surfaces::new("normals", normal, Sides::Outermost, &head, bodies)
}

/// The faces, ready to be drawn.
pub(crate) struct DrawnNormals {
    faces: Vec<(DrawnSurfaces, Resources)>,
    changes: bool,
}

impl DrawnNormals {
    /// Makes pipelines and memory; the cube goes to `shown`.
    pub(crate) fn new(
        bodies: &Maker<'_>,
        surfaces: &Surfaces,
        view: &Viewed<'_>,
        shown: &mut Resources,
    ) -> Result<Self, Error> {
        let maker = bodies.clone().resized([SIZE_PX; 2]);
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let format = wgpu::TextureFormat::Rgba32Float;
        let size = [SIZE_PX, SIZE_PX, 6];
        let cube = maker.allocator.texture("normal_faces", size, format, usage)?;
        let mut faces = Vec::new();
        for (index, name) in FACES.into_iter().enumerate() {
            let mut own = Resources::default();
            for name in ["bodies", "bumps"] {
                shown.share(&mut own, name);
            }
            let numbers = frame_uniforms::numbers(view, 0);
            let numbers = numbers.of_cube_face(index, view.geometry.middle_lc, SIZE_PX, 0);
            let bytes = uniforms::bytes_of(&numbers);
            let uniform = BufferUsages::UNIFORM;
            own.buffer("frame", maker.allocator.filled("frame of a face", &bytes, uniform)?);
            own.layer("normal_face", &cube, index as u32);
            let drawn = maker.surfaces(surfaces, &mut own)?.named(name);
            faces.push((drawn, own));
        }
        shown.texture_as("normal_faces", cube, wgpu::TextureViewDimension::D2Array);
        Ok(Self { faces, changes: view.geometry.changes })
    }

    /// Draws the cube, in the first frame only if nothing moves.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, first: bool) {
        if first || self.changes {
            for (face, own) in &self.faces {
                face.record(recorder, own);
            }
        }
    }
}
