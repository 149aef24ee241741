//! The passes of each strategy of peeling, as far as they can be known without a
//! GPU.

use super::camera;
use super::strategy::Strategy;
use crate::composition::inputs::Inputs;
use crate::composition::layer_images::MAX_LAYERS;
use crate::drawn::frame_uniforms::FrameUniform;
use crate::error::Error;
use crate::passes::raster_pass::{Files, RasterPass, Sides, Target};
use crate::plan::entries::Entries;
use crate::wgsl::Shader;
use encase::ShaderType;
use scenes::Camera;
use wgpu::TextureFormat;

/// The passes that find and sort every interface of a pixel.
pub(super) struct Peel {
    pub(super) strategy: Strategy,
    pub(super) max_layers: u32,
    /// A camera of the layers' own.
    pub(super) camera: Option<Camera>,
    /// Of the layers.
    pub(super) resolution_px: [u32; 2],
    pub(super) count: RasterPass,
    pub(super) collect: RasterPass,
    /// After each drawing.
    pub(super) keep: Option<Step>,
    /// Once, at the end.
    pub(super) finish: Option<Step>,
}

/// A compute pass over all pixels.
pub(super) struct Step {
    pub(super) pass: &'static str,
    pub(super) entry_point: &'static str,
    pub(super) shader: Shader,
}

/// Names of the passes' own.
pub(super) const CLEAR: &str = "clear layers";
pub(super) const CLEAR_OWN: &str = "clear what was found";
/// The camera's numbers, where layers have one of their own.
pub(super) const FRAME_OF_LAYERS: &str = "frame of the layers";
/// Images of the layers.
pub(super) const LAYERS: [&str; 2] = ["slot_depths", "slot_normals"];
/// After what is stated for one layer, or pair of layers, because they are not
/// counted yet.
const PER_LAYER: &str = " (per layer)";

const fn target(name: &'static str, location: u32, format: TextureFormat) -> Target {
    Target { name, location, format }
}

/// What a pass writes as colour that stores what it finds: nothing. A raster pass
/// must have a target.
const STORED: Target = target("no colour", 0, TextureFormat::R8Unorm);
const NEAREST: Target = target("peeled", 0, TextureFormat::Rg32Uint);
const EXTREMES: Target = target("dual_extremes", 0, TextureFormat::Rg32Float);
const NORMALS: Target = target("dual_normals", 1, TextureFormat::Rgba32Float);

impl Peel {
    pub(super) fn new(inputs: &Inputs<'_>) -> Result<Self, Error> {
        let strategy = Strategy::of(inputs.settings);
        let stored = |name, file: &str| {
            let choices = inputs.choices.with("stored_interface", file);
            let files = Files { targets: "stored_targets", analytic: Some("analytic_targets") };
            let bodies = &inputs.geometry.bodies;
            RasterPass::new(name, vec![STORED], Sides::All, &files, &choices, bodies)
        };
        let peeled = |name, targets, sides, file: &'static str| {
            let files = Files { targets: file, analytic: Some("analytic_targets") };
            RasterPass::new(name, targets, sides, &files, &inputs.choices, &inputs.geometry.bodies)
        };
        let collect = match strategy {
            Strategy::Slots => stored("collect layers", "peel_slots"),
            Strategy::Cascade => stored("collect layers", "peel_cascade"),
            Strategy::Everitt => {
                peeled("peel layer", vec![NEAREST], Sides::Nearest, "peel_everitt")
            }
            Strategy::Dual => {
                peeled("peel pair", vec![EXTREMES, NORMALS], Sides::Largest, "peel_dual")
            }
        };
        let camera = camera::fitted(inputs)?;
        Ok(Self {
            strategy,
            max_layers: inputs.settings.whole_if_any("max_layers").unwrap_or(MAX_LAYERS),
            resolution_px: camera.map_or(inputs.resolution_px, |camera| camera.resolution_px),
            camera,
            count: stored("count layers", "peel_count")?,
            collect: collect?,
            keep: Step::keep(strategy, inputs)?,
            finish: Step::finish(strategy, inputs)?,
        })
    }

    /// Adds its passes. Before layers are counted, repeated ones are stated once,
    /// per layer or per pair of layers.
    pub(super) fn plan_passes(&self, entries: &mut Entries<'_>) {
        let counted = entries.counted;
        entries.pass(CLEAR);
        if self.strategy.own_buffer(1).is_some() {
            entries.pass(CLEAR_OWN);
        }
        let suffix = if counted.is_none() && self.strategy.repeats() { PER_LAYER } else { "" };
        for _ in 0..counted.map_or(1, |counted| self.strategy.draws(counted)) {
            let drawn = [Some(self.collect.name), self.keep.as_ref().map(|step| step.pass)];
            drawn.into_iter().flatten().for_each(|name| entries.pass(&format!("{name}{suffix}")));
        }
        if let Some(finish) = &self.finish {
            entries.pass(finish.pass);
        }
    }

    /// Adds its memory. Before layers are counted, what grows with their number is
    /// stated for one.
    pub(super) fn plan_buffers(&self, entries: &mut Entries<'_>) {
        let pixels: u64 = self.resolution_px.map(u64::from).iter().product();
        let capacity = entries.counted.map_or(1, |counted| counted.capacity);
        let suffix = if entries.counted.is_none() { PER_LAYER } else { "" };
        entries.buffer("slot_counts", 4 * pixels);
        if self.camera.is_some() {
            entries.buffer(FRAME_OF_LAYERS, FrameUniform::min_size().get());
        }
        entries.buffer(STORED.name, STORED.bytes(pixels));
        for target in self.collect.targets.iter().filter(|target| **target != STORED) {
            entries.buffer(target.name, target.bytes(pixels));
        }
        self.collect.plan_depth_test(entries, pixels);
        if let Some((name, bytes)) = self.strategy.own_buffer(capacity) {
            let suffix = if self.strategy == Strategy::Cascade { suffix } else { "" };
            entries.buffer(&format!("{name}{suffix}"), bytes * pixels);
        }
        for name in LAYERS {
            entries.buffer(&format!("{name}{suffix}"), 4 * pixels * u64::from(capacity));
        }
        // Both sides of every analytic body, to be counted and to be collected.
        entries.analytic_bodies(4);
    }
}

impl Step {
    fn new(
        pass: &'static str,
        entry_point: &'static str,
        file: &str,
        inputs: &Inputs<'_>,
    ) -> Result<Option<Self>, Error> {
        let shader = Shader::compose(&[file], &inputs.choices)?;
        Ok(Some(Self { pass, entry_point, shader }))
    }

    fn keep(strategy: Strategy, inputs: &Inputs<'_>) -> Result<Option<Self>, Error> {
        match strategy {
            Strategy::Everitt => Self::new("keep layer", "keep_layer", "peel_everitt_keep", inputs),
            Strategy::Dual => Self::new("keep pair", "keep_pair", "peel_dual_keep", inputs),
            Strategy::Slots | Strategy::Cascade => Ok(None),
        }
    }

    fn finish(strategy: Strategy, inputs: &Inputs<'_>) -> Result<Option<Self>, Error> {
        match strategy {
            Strategy::Slots => Self::new("sort layers", "peel_sort", "peel_sort", inputs),
            Strategy::Dual => Self::new("close layers", "close_layers", "peel_dual_close", inputs),
            Strategy::Cascade => {
                Self::new("unpack layers", "unpack_layers", "peel_cascade_unpack", inputs)
            }
            Strategy::Everitt => Ok(None),
        }
    }
}
