//! The passes of each way of peeling, as far as they can be known without a GPU.

use super::camera;
use super::strategy::{Counted, MAX_LAYERS, Way};
use crate::Error;
use crate::composition::chosen::piece;
use crate::composition::inputs::Order;
use crate::drawn::uniforms;
use crate::passes::raster_pass::{STORED, Sides, Surfaces, Target};
use crate::wgsl::{Piece, Shader};
use encase::ShaderType;
use scenes::Camera;
use scenes::plan::Buffer;
use wgpu::TextureFormat;

/// The passes that find and sort every interface of a pixel.
pub(crate) struct Peel {
    pub(crate) way: Way,
    pub(crate) max_layers: u32,
    /// A camera of the layers' own.
    pub(crate) camera: Option<Camera>,
    /// Of the layers.
    pub(crate) resolution_px: [u32; 2],
    pub(crate) count: Surfaces,
    pub(crate) collect: Surfaces,
    /// After each drawing.
    pub(crate) keep: Option<Step>,
    /// Once, at the end.
    pub(crate) finish: Option<Step>,
}

/// A compute pass over all pixels.
pub(crate) struct Step {
    pub(crate) pass: &'static str,
    pub(crate) entry_point: &'static str,
    pub(crate) shader: Shader,
}

impl Step {
    fn new(pass: &'static str, entry_point: &'static str, piece: Piece) -> Result<Self, Error> {
        let shader = Shader::link(&[piece!("core/frame.wgsl"), piece])?;
        Ok(Self { pass, entry_point, shader })
    }
}

/// The camera's numbers, where layers have one of their own.
pub(super) const FRAME_OF_LAYERS: &str = "frame of the layers";
/// Name of the clearing of a way's own buffer.
pub(crate) const CLEAR_OWN: &str = "clear what was found";

const fn found(
    name: &'static str,
    format: TextureFormat,
    channels: u32,
    value: &'static str,
) -> Target {
    let wgsl_type = match format {
        TextureFormat::Rg32Uint => "vec2u",
        TextureFormat::Rg32Float => "vec2f",
        _ => "vec4f",
    };
    Target { name, format, channels, wgsl_type, value }
}

const NEAREST: Target = found("peeled", TextureFormat::Rg32Uint, 2, "peeled_interface(v)");
const EXTREMES: Target = found("dual_extremes", TextureFormat::Rg32Float, 2, "dual_extremes(v)");
const NORMALS: Target = found("dual_normals", TextureFormat::Rgba32Float, 4, "dual_normals(v)");

impl Peel {
    pub(crate) fn new(order: &Order<'_>, head: &[Piece]) -> Result<Self, Error> {
        let draw = |name, targets, sides, tail: Vec<Piece>| {
            let head: Vec<Piece> = head.iter().cloned().chain(tail).collect();
            Surfaces::new(name, targets, sides, &head, &order.geometry.bodies)
        };
        let way = Way::of(order.settings);
        let tail = |piece| vec![order.pack(), piece!("layers/peel/peel_packed.wgsl"), piece];
        let (name, targets, sides, piece) = match way {
            Way::Slots => {
                ("collect layers", vec![STORED], Sides::All, piece!("layers/peel/peel_slots.wgsl"))
            }
            Way::Cascade => (
                "collect layers",
                vec![STORED],
                Sides::All,
                piece!("layers/peel/peel_cascade.wgsl"),
            ),
            Way::Everitt => (
                "peel layer",
                vec![NEAREST],
                Sides::Nearest,
                piece!("layers/peel/peel_everitt.wgsl"),
            ),
            Way::Dual => (
                "peel pair",
                vec![EXTREMES, NORMALS],
                Sides::Largest,
                piece!("layers/peel/peel_dual.wgsl"),
            ),
        };
        let keep = match way {
            Way::Everitt => Some(Step::new(
                "keep layer",
                "keep_layer",
                piece!("layers/peel/peel_everitt_keep.wgsl"),
            )?),
            Way::Dual => Some(Step::new(
                "keep pair",
                "keep_pair",
                piece!("layers/peel/peel_dual_keep.wgsl"),
            )?),
            _ => None,
        };
        let finish = match way {
            Way::Slots => {
                Some(Step::new("sort layers", "peel_sort", piece!("layers/peel/peel_sort.wgsl"))?)
            }
            Way::Dual => Some(Step::new(
                "close layers",
                "close_layers",
                piece!("layers/peel/peel_dual_close.wgsl"),
            )?),
            Way::Cascade => {
                let piece = piece!("layers/peel/peel_cascade_unpack.wgsl");
                Some(Step::new("unpack layers", "unpack_layers", piece)?)
            }
            Way::Everitt => None,
        };
        let count = vec![piece!("layers/peel/peel_count.wgsl")];
        let camera = camera::fitted(order)?;
        Ok(Self {
            way,
            resolution_px: camera.map_or(order.resolution_px, |camera| camera.resolution_px),
            camera,
            max_layers: order.settings.number_if_any("max_layers").unwrap_or(MAX_LAYERS.into())
                as u32,
            count: draw("count layers", vec![STORED], Sides::All, count)?,
            collect: draw(name, targets, sides, tail(piece))?,
            keep,
            finish,
        })
    }

    /// Passes of a frame. Before layers are counted, repeated ones are stated
    /// once, per layer or per pair of layers.
    pub(crate) fn passes(&self, counted: Option<Counted>) -> Vec<String> {
        let mut passes = vec!["clear layers".to_owned()];
        if self.way.own_buffer(1).is_some() {
            passes.push(CLEAR_OWN.to_owned());
        }
        let suffix = if counted.is_none() && self.way.repeats() { PER_LAYER } else { "" };
        for _ in 0..counted.map_or(1, |counted| self.way.draws(counted)) {
            let drawn = [Some(self.collect.name), self.keep.as_ref().map(|step| step.pass)];
            passes.extend(drawn.into_iter().flatten().map(|name| format!("{name}{suffix}")));
        }
        passes.extend(self.finish.as_ref().map(|step| step.pass.to_owned()));
        passes
    }

    /// Memory beside the uniforms of analytic bodies. Before layers are counted,
    /// what grows with their number is stated for one.
    pub(crate) fn buffers(&self, counted: Option<Counted>) -> Vec<Buffer> {
        let pixels: u64 = self.resolution_px.map(u64::from).iter().product();
        let capacity = counted.map_or(1, |counted| counted.capacity);
        let suffix = if counted.is_none() { PER_LAYER } else { "" };
        let buffer = |name: &str, bytes| Buffer { name: name.to_owned(), bytes };
        let mut buffers = vec![buffer("slot_counts", 4 * pixels)];
        if self.camera.is_some() {
            buffers.push(buffer(FRAME_OF_LAYERS, uniforms::Frame::min_size().get()));
        }
        // A raster pass must have a target, though nothing is written to it.
        buffers.push(buffer(STORED.name, STORED.bytes(pixels)));
        for target in self.collect.targets.iter().filter(|target| **target != STORED) {
            buffers.push(buffer(target.name, target.bytes(pixels)));
        }
        if self.collect.sides.has_depth() {
            buffers.push(buffer(&format!("{} depth test", self.collect.name), 4 * pixels));
        }
        if let Some((name, bytes)) = self.way.own_buffer(capacity) {
            let suffix = if self.way == Way::Cascade { suffix } else { "" };
            buffers.push(buffer(&format!("{name}{suffix}"), bytes * pixels));
        }
        for name in ["slot_depths", "slot_normals"] {
            buffers.push(buffer(&format!("{name}{suffix}"), 4 * pixels * u64::from(capacity)));
        }
        buffers
    }
}

/// After what is stated for one layer, or pair of layers, because they are not
/// counted yet.
const PER_LAYER: &str = " (per layer)";
