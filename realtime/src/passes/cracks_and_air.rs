//! What is inside a body and drawn as an overlay: sheets of cracks that glitter,
//! clipped by the body's depth interval, and planes of enclosed air. Source:
//! Seipel & Nivfors, "Efficient rendering of multiple refractions and
//! reflections in natural objects", SIGRAD 2006.

use super::pipelines::ReadyRaster;
use super::raster_pass::{Files, RasterPass, Sides, Target};
use super::{Composed, Listed, Maker, Making, Pass, Ready, Record, Wanted};
use crate::composition::inputs::Inputs;
use crate::drawn::frame_uniforms::{self, FrameUniform, Viewed};
use crate::drawn::uniforms;
use crate::error::Error;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::plan::entries::Entries;
use crate::wgsl::Choices;
use encase::ShaderType;
use scenes::plan::{Kind, Unsupported};
use wgpu::{BufferUsages, TextureFormat};

pub(crate) const LISTED: Listed = Listed { compose, absent };

const CRACK_MASK: &str = "crack_mask";
const CLIP: Files = Files { targets: "clip_targets", analytic: Some("clip_analytic") };

/// The passes that draw the inside.
struct CracksAndAir {
    /// The body's depth interval, where the frame's own does not serve.
    clip: Option<[RasterPass; 2]>,
    cracks: Option<RasterPass>,
    air: Option<RasterPass>,
    /// Cracks drawn over the body's back normals.
    onto_back: Option<RasterPass>,
    resolution_px: [u32; 2],
    frame_px: [u32; 2],
}

/// None if the scene has neither cracks nor air, or the method shows none.
fn compose(inputs: &Inputs<'_>, _: &Wanted<'_>) -> Composed {
    if inputs.is_off_screen() || !(inputs.shows_cracks() || inputs.shows_air()) {
        return Ok(None);
    }
    let resolution_px = resolution_px(inputs);
    let (geometry, settings) = (inputs.geometry, inputs.settings);
    // The frame's own depths serve where they are as many and as precise.
    let precise = settings.word("depth_format") == "float";
    let shared = precise && resolution_px == inputs.resolution_px;
    let by_depth = settings.word("clip") == "depth";
    let choices = clipped(inputs, shared);
    let cracks = inputs.shows_cracks().then(|| {
        let targets = crack_targets(inputs);
        let files = only_meshes("cracks");
        RasterPass::new("cracks", targets, Sides::Sum, &files, &choices, &geometry.cracks)
    });
    let air = inputs.shows_air().then(|| {
        let colour = Target { format: TextureFormat::Rgba8Unorm, ..Target::rgba("air", 0) };
        let files = only_meshes("air");
        RasterPass::new("air", vec![colour], Sides::Over, &files, &choices, &geometry.air)
    });
    let clip = (by_depth && !shared).then(|| depth_interval(inputs));
    Ok(Some(Box::new(CracksAndAir {
        clip: clip.transpose()?,
        cracks: cracks.transpose()?,
        air: air.transpose()?,
        onto_back: onto_back(inputs)?,
        resolution_px,
        frame_px: inputs.resolution_px,
    })))
}

fn absent(entries: &mut Entries<'_>) {
    let geometry = entries.geometry;
    if !geometry.cracks.is_empty() || !geometry.air.is_empty() {
        entries.plan.unsupported.push(Unsupported {
            what: "cracks and enclosed air".to_owned(),
            instead: "the inside of the body is clear".to_owned(),
        });
    }
    leave_out(entries);
}

fn leave_out(entries: &mut Entries<'_>) {
    let (geometry, pixels) = (entries.geometry, entries.pixels);
    if geometry.cracks.is_empty() {
        entries.plan.leave_out(Kind::Pass, "cracks", "no body is cracked", 8 * pixels);
    }
    if geometry.air.is_empty() {
        entries.plan.leave_out(Kind::Pass, "air", "no body encloses air", 4 * pixels);
    }
}

const fn only_meshes(targets: &'static str) -> Files {
    Files { targets, analytic: None }
}

/// Layers are those of the frame; everything else has a size of its own.
fn resolution_px(inputs: &Inputs<'_>) -> [u32; 2] {
    let size = inputs.settings.number("interior_px") as u32;
    let by_layers = inputs.settings.word("clip") == "layers";
    if size == 0 || by_layers || inputs.asked_for(CRACK_MASK) {
        inputs.resolution_px
    } else {
        [size; 2]
    }
}

fn crack_targets(inputs: &Inputs<'_>) -> Vec<Target> {
    let light = Target { format: TextureFormat::Rgba16Float, ..Target::rgba("cracks", 0) };
    let mask = inputs.asked_for(CRACK_MASK).then_some(Target::r(CRACK_MASK, 1));
    [light].into_iter().chain(mask).collect()
}

/// How what is drawn inside ends at the body's surface.
fn clipped(inputs: &Inputs<'_>, shared: bool) -> Choices {
    let clip = match inputs.settings.word("clip") {
        "layers" => "clip_layers",
        // Sheets that were cut beforehand end by themselves.
        "mesh" | "none" => "clip_none",
        _ => "clip_depth",
    };
    let interval = if shared { "interval_of_frame" } else { "interval_of_clip" };
    inputs.choices.with("clip", clip).with("depth_interval", interval)
}

/// Nearest and farthest depth of the bodies, as they are stored.
fn depth_interval(inputs: &Inputs<'_>) -> Result<[RasterPass; 2], Error> {
    let (choices, bodies) = (&inputs.choices, &inputs.geometry.bodies);
    let pass = |name, target, sides| {
        RasterPass::new(name, vec![Target::r(target, 0)], sides, &CLIP, choices, bodies)
    };
    Ok([
        pass("clip front", "clip_front", Sides::Front)?,
        pass("clip back", "clip_back", Sides::Back { farthest: true })?,
    ])
}

fn onto_back(inputs: &Inputs<'_>) -> Result<Option<RasterPass>, Error> {
    let bends = inputs.settings.number("a") > 0.0;
    let wanted = bends && inputs.settings.word("crack_normals") == "back";
    if !wanted || !inputs.shows_cracks() {
        return Ok(None);
    }
    let mut choices = inputs.choices.with("clip", "clip_depth");
    choices.choose("depth_interval", "interval_of_frame");
    choices.choose("depth_format", "depth_format_float");
    let targets = vec![Target::rgba("back_normal", 0)];
    let (files, cracks) = (only_meshes("cracks_onto_normals"), &inputs.geometry.cracks);
    let name = "cracks onto normals";
    RasterPass::new(name, targets, Sides::Onto, &files, &choices, cracks).map(Some)
}

impl CracksAndAir {
    /// Its passes but the one onto normals, in the order in which they run.
    fn passes(&self) -> impl Iterator<Item = &RasterPass> {
        let clip = self.clip.iter().flatten();
        clip.chain(&self.cracks).chain(&self.air)
    }

    /// The numbers of the inside, and a frame of its size.
    fn numbers(&self, making: &Making<'_>) -> Result<Outputs, Error> {
        let (view, allocator) = (making.view, making.bodies.allocator);
        let mut own = Outputs::default();
        if self.resolution_px != view.resolution_px {
            let resized = Viewed { resolution_px: self.resolution_px, ..*view };
            let bytes = uniforms::bytes_of(&frame_uniforms::numbers(&resized, 0));
            let buffer = allocator.filled("frame of the inside", &bytes, BufferUsages::UNIFORM)?;
            own.buffer("frame", buffer);
        }
        let numbers = uniforms::Interior {
            towards_light_ws: view.geometry.towards_light_ws,
            size_m: view.geometry.extent.radius_m as f32,
        };
        let bytes = uniforms::bytes_of(&numbers);
        own.buffer("interior", allocator.filled("interior", &bytes, BufferUsages::UNIFORM)?);
        Ok(own)
    }
}

impl Pass for CracksAndAir {
    fn reads(&self, global: &str) -> bool {
        let drawn = [&self.cracks, &self.air, &self.onto_back];
        drawn.into_iter().flatten().any(|pass| pass.reads(global))
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        let geometry = entries.geometry;
        let pixels = self.resolution_px.map(u64::from).iter().product();
        if self.resolution_px != self.frame_px {
            entries.buffer("frame of the inside", FrameUniform::min_size().get());
        }
        entries.buffer("interior", uniforms::Interior::min_size().get());
        if let Some(onto_back) = &self.onto_back {
            entries.corners(&geometry.cracks);
            entries.pass(onto_back.name);
        }
        for pass in self.passes() {
            pass.plan(entries, pixels);
            if pass.sides.has_depth() {
                entries.analytic_bodies(1);
            }
            entries.pass(pass.name);
        }
        if self.cracks.is_some() {
            entries.corners(&geometry.cracks);
        }
        if self.air.is_some() {
            entries.corners(&geometry.air);
        }
        if self.clip.is_none() {
            let reason = "the frame's own depths, layers or sheets end cracks and air";
            entries.plan.leave_out(Kind::Pass, "clip front, clip back", reason, 16 * pixels);
        }
        leave_out(entries);
    }

    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let (view, bodies) = (making.view, &making.bodies);
        let geometry = view.geometry;
        let of = |parts, size_px| Maker::new(bodies.gpu, bodies.allocator, parts, size_px);
        let mut passes = Vec::new();
        if let Some(onto_back) = &self.onto_back {
            let maker = of(&geometry.cracks, view.resolution_px)?;
            passes.push(maker.raster(onto_back, making.before)?.0);
        }
        let numbers = self.numbers(making)?;
        let following = numbers.buffer_named("frame").map(|own| (own.clone(), self.resolution_px));
        let mut resources = numbers.over(making.before);
        let resized = bodies.clone().resized(self.resolution_px);
        for clip in self.clip.iter().flatten() {
            let (pass, images) = resized.raster(clip, &resources)?;
            passes.push(pass);
            resources = images.over(&resources);
        }
        let mut outputs = Outputs::default();
        let insides = [(&self.cracks, &geometry.cracks), (&self.air, &geometry.air)];
        for (inside, drawables) in insides {
            if let Some(inside) = inside {
                let maker = of(drawables, self.resolution_px)?;
                let (pass, images) = maker.raster(inside, &resources)?;
                passes.push(pass);
                outputs = images.over(&outputs);
            }
        }
        Ok(Ready { following, ..Ready::new(ReadyCracksAndAir(passes), outputs) })
    }
}

/// The inside, ready to be drawn.
struct ReadyCracksAndAir(Vec<ReadyRaster>);

impl Record for ReadyCracksAndAir {
    fn record(&self, recorder: &mut Recorder<'_>, _: bool) {
        self.0.iter().for_each(|pass| pass.record(recorder));
    }
}
