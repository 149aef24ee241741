//! What every pixel shows: the method at work, or what is around the bodies.

use super::pipelines::OverPixels;
use super::{Composed, Listed, Making, Pass, Ready, Record, Wanted};
use crate::composition::chosen::OUTPUTS;
use crate::composition::inputs::Inputs;
use crate::error::Error;
use crate::gpu::environment_upload::upload_environment;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::plan::entries::Entries;
use crate::wgsl::Shader;
use scenes::plan::{Kind, Unsupported};
use wgpu::{TextureFormat, TextureUsages};

pub(crate) const LISTED: Listed = Listed { compose, absent: |_| () };

const ENTRY_POINT: &str = "shade";

struct Shade {
    shader: Shader,
    /// Images that it writes.
    outputs: Vec<&'static str>,
    /// Nobody drew surroundings that stand for the environment.
    reads_environment: bool,
}

fn compose(inputs: &Inputs<'_>, _: &Wanted<'_>) -> Composed {
    let rays = inputs.method.follows_rays;
    let roots: &[&str] = if inputs.follows_rays() {
        &["shade_rays"]
    } else if inputs.is_off_screen() || rays {
        &["shade_background"]
    } else if inputs.may_need_anything() {
        &["shade", "anything"]
    } else {
        &["shade"]
    };
    Ok(Some(Box::new(Shade {
        shader: Shader::compose(roots, &inputs.choices)?,
        outputs: inputs.outputs.to_vec(),
        reads_environment: !inputs.draws_backdrop(),
    })))
}

impl Pass for Shade {
    fn reads(&self, global: &str) -> bool {
        self.shader.uses(&[ENTRY_POINT], global)
    }

    fn draws_bodies(&self) -> bool {
        false
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        if self.reads_environment {
            entries.environment();
        }
        for output in OUTPUTS {
            let bytes = entries.pixels * 16;
            if self.outputs.contains(&output) {
                entries.buffer(output, bytes);
            } else {
                entries.plan.leave_out(Kind::Buffer, output, "nobody asked for it", bytes);
            }
        }
        entries.pass(ENTRY_POINT);
        leave_out(entries);
    }

    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let (gpu, allocator) = (making.bodies.gpu, making.bodies.allocator);
        let view = making.view;
        let mut outputs = Outputs::default();
        if self.reads_environment {
            let reader = (&self.shader, ENTRY_POINT);
            outputs = upload_environment(gpu, allocator, reader, view.environment)?;
        }
        let [width, height] = view.resolution_px;
        let usage = TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC;
        for output in &self.outputs {
            let (size, format) = ([width, height, 1], TextureFormat::Rgba32Float);
            outputs.texture(output, allocator.texture(output, size, format, usage)?);
        }
        let resources = outputs.clone().over(making.before);
        let work = making.bodies.over_pixels(&self.shader, ENTRY_POINT, &resources)?;
        Ok(Ready::new(ReadyShade { work, resolution_px: view.resolution_px }, outputs))
    }
}

/// What the scene does not need, and what it has and the method does not show.
fn leave_out(entries: &mut Entries<'_>) {
    let (geometry, inputs) = (entries.geometry, entries.inputs);
    let plan = &mut entries.plan;
    if !geometry.absorbs {
        plan.leave_out(Kind::Code, "absorption", "no medium absorbs", 0);
    }
    if !geometry.disperses {
        plan.leave_out(Kind::Code, "traces of red and blue", "no medium disperses", 0);
    }
    if inputs.index_matched {
        let reason = "the bodies have the index of what is around them: light goes straight on";
        plan.leave_out(Kind::Code, "refraction and reflection", reason, 0);
    }
    if geometry.disperses && !inputs.method.traces_colours {
        plan.unsupported.push(Unsupported {
            what: "dispersion".to_owned(),
            instead: "light of all colours takes the way of the d line".to_owned(),
        });
    }
}

struct ReadyShade {
    work: OverPixels,
    resolution_px: [u32; 2],
}

impl Record for ReadyShade {
    fn record(&self, recorder: &mut Recorder<'_>, _: bool) {
        self.work.record(recorder, ENTRY_POINT, self.resolution_px);
    }
}
