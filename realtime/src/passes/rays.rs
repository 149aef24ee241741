//! What rays meet, for methods that follow them: uploaded, and nothing drawn.

use super::backdrop::surroundings_bytes;
use super::{Composed, Listed, Making, Pass, Ready, Record, Wanted};
use crate::composition::inputs::Inputs;
use crate::drawn::geometry::Geometry;
use crate::drawn::uniforms;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::limits::Limits;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::plan::counted::Counted;
use crate::plan::entries::Entries;
use crate::plan::timing::REFIT;
use scenes::plan::Kind;
use wgpu::BufferUsages;

pub(crate) const LISTED: Listed = Listed { compose, absent: |_| () };

/// Everything that it can hand on.
const BUFFERS: [&str; 6] =
    ["ray_nodes", "ray_triangles", "ray_bodies", "ray_normals", "ray_analytic", "surroundings"];

struct Rays {
    /// Of each buffer that is read.
    bytes: Vec<(&'static str, u64)>,
}

fn compose(inputs: &Inputs<'_>, wanted: &Wanted<'_>) -> Composed {
    if !inputs.follows_rays() {
        return Ok(None);
    }
    let buffers = BUFFERS.into_iter().filter(|name| wanted.reads(name));
    let bytes = |name| contents(name, inputs.geometry).len() as u64;
    let bytes = buffers.map(|name| (name, bytes(name))).collect();
    Ok(Some(Box::new(Rays { bytes })))
}

/// The bytes of a buffer.
fn contents(name: &str, geometry: &Geometry) -> Vec<u8> {
    let rays = geometry.rays();
    match name {
        "ray_nodes" => bytemuck::cast_slice(&rays.nodes).to_vec(),
        "ray_triangles" => bytemuck::cast_slice(&rays.triangles).to_vec(),
        "ray_bodies" => bytemuck::cast_slice(&rays.bodies).to_vec(),
        "ray_normals" => bytemuck::cast_slice(&rays.normals).to_vec(),
        "ray_analytic" => uniforms::stored_bytes_of(&rays.analytic),
        _ => surroundings_bytes(geometry),
    }
}

impl Pass for Rays {
    fn reads(&self, _: &str) -> bool {
        false
    }

    fn draws_bodies(&self) -> bool {
        false
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        for (name, bytes) in &self.bytes {
            entries.buffer(name, *bytes);
        }
        let rays = entries.geometry.rays();
        let plan = &mut entries.plan;
        if rays.refit_ms.is_some() {
            plan.passes.insert(0, REFIT.to_owned());
        } else if !rays.nodes.is_empty() {
            let reason = "nothing moves: the tree was built once, before the first frame";
            plan.leave_out(Kind::Pass, REFIT, reason, 0);
        }
        if rays.nodes.is_empty() {
            let reason = "no body has triangles: there is no tree, and no stack to search it";
            plan.leave_out(Kind::Buffer, "ray_nodes, ray_triangles, ray_bodies", reason, 0);
        } else if !self.bytes.iter().any(|(name, _)| *name == "ray_normals") {
            let bytes = 36 * rays.triangles.len() as u64;
            plan.leave_out(Kind::Buffer, "ray_normals", "every triangle is flat", bytes);
        }
        if !entries.geometry.nested {
            let reason = "there is one kind of solid: a count of one number";
            plan.leave_out(Kind::Code, "windings of several solids", reason, 0);
        }
    }

    fn check(&self, gpu: &Gpu, _: Option<Counted>) -> Result<(), Error> {
        let limits = Limits::of(gpu);
        let mut of_triangles = self.bytes.iter();
        of_triangles
            .try_for_each(|(name, bytes)| limits.binding(name, *bytes, "use fewer triangles"))
    }

    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let mut outputs = Outputs::default();
        let allocator: &Allocator<'_> = making.bodies.allocator;
        for (name, _) in &self.bytes {
            let bytes = contents(name, making.view.geometry);
            let usage = match *name {
                "surroundings" => BufferUsages::UNIFORM,
                _ => BufferUsages::STORAGE,
            };
            outputs.buffer(name, allocator.filled(name, &bytes, usage)?);
        }
        Ok(Ready::new(Uploaded, outputs))
    }
}

/// It is there before the first frame.
struct Uploaded;

impl Record for Uploaded {
    fn record(&self, _: &mut Recorder<'_>, _: bool) {}
}
