//! A method's image of a scene.

use crate::composition::{Composition, Filter, Order};
use crate::frame::{Frame, Viewed};
use crate::geometry::Geometry;
use crate::method::{Method, Settings};
use crate::peel::{Counted, LayerPart};
use crate::recorder::{Allocator, Executed, Recorder};
use crate::{Error, Gpu, plan, readback};
use scenes::rendering::{Pass, Provenance, Time, TimeSource};
use scenes::{Camera, LayerName, Layers, Plan, Rendering, Scene, View};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::time::Instant;

/// What a method is asked.
#[derive(Clone, Debug)]
pub struct Request {
    /// What every renderer is asked.
    pub view: View,
    /// Id or alias of the method.
    pub method: String,
    /// Parameters as `name = value`; the others have their defaults.
    pub parameters: BTreeMap<String, String>,
    /// How the environment is looked up.
    pub filter: Filter,
    /// How long to measure, if at all.
    pub timing: Option<Timing>,
    /// Leave out what the scene does not need. False keeps, with neutral input, the
    /// surface buffers that nobody reads, stored geometric normals, absorption,
    /// traces of red and blue, refraction at equal indices, bodies and pixels
    /// outside the image: to see that the image is the same and what is saved.
    /// Cracks, air, bumps and surroundings that a scene does not have stay out.
    pub elide: bool,
}

/// How long frames are timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Frames that are not counted.
    pub warm_up: u32,
    /// At least this long, seconds.
    pub seconds: f64,
    /// At most this many frames.
    pub max_frames: u32,
}

impl Default for Timing {
    fn default() -> Self {
        Self { warm_up: 2, seconds: 0.3, max_frames: 200 }
    }
}

/// Renders a scene with a method.
///
/// Radiance is the mean over k x k positions of a frame k times as large; the
/// direction layers come from a frame of their own at pixel centres. What is
/// timed is a third one: one position per pixel, light only, filtered by the
/// hardware.
///
/// # Errors
/// If the request does not fit the method, or the GPU fails.
pub fn render(gpu: &Gpu, scene: &Scene, request: &Request) -> Result<Rendering, Error> {
    let method = Method::find(&request.method)?;
    let settings = Settings::new(method, &request.parameters)?;
    let geometry = Geometry::new(scene, request.view.frame)?;
    let wanted = outputs(method, request)?;
    let camera = camera(scene, request);
    let job = Job { gpu, scene, request, method, settings: &settings, geometry: &geometry, camera };
    gpu.scoped(|| job.run(&wanted))
}

struct Job<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    request: &'a Request,
    method: &'static Method,
    settings: &'a Settings,
    geometry: &'a Geometry,
    camera: Camera,
}

impl Job<'_> {
    fn run(&self, wanted: &[&'static str]) -> Result<Rendering, Error> {
        let mut layers = Layers::new(self.request.view.resolution_px);
        let mut done = Done::default();
        let mut plan = Plan::default();
        for part in parts(self.request, wanted) {
            let part = part.on(self.gpu);
            let ran = self.frame(&part)?;
            let layers_held = ran.frame.layers();
            plan::add(&mut plan, &ran.composition, self.scene, self.geometry, &part, layers_held);
            done.layers(layers_held, &part);
            done.bytes += ran.allocator.allocated().iter().map(|buffer| buffer.bytes).sum::<u64>();
            let timed = match (part.label, self.request.timing) {
                (TIMED, Some(timing)) => self.time(&ran.frame, timing)?,
                _ => Vec::new(),
            };
            let per_frame_ms = ran.thickness_ms.filter(|_| self.geometry.deforms);
            done.add(part.label, &ran.executed.passes, &timed, per_frame_ms);
            if part.label == TIMED {
                continue;
            }
            if part.outputs.contains(&"radiance") {
                self.read_radiance(&ran, part.scale, &mut layers)?;
            }
            if part.scale == 1 {
                self.read_single(&ran, &part.request, &mut layers)?;
            }
        }
        Ok(self.answer(done, plan, layers))
    }

    fn frame(&self, part: &Part) -> Result<Ran<'_>, Error> {
        let order = Order {
            method: self.method,
            settings: self.settings,
            scene: self.scene,
            camera: &self.camera,
            geometry: self.geometry,
            request: &part.request,
            outputs: &part.outputs,
            resolution_px: part.resolution_px(),
        };
        let composition = Composition::new(&order)?;
        let allocator = Allocator::new(self.gpu);
        let mut geometry = Cow::Borrowed(self.geometry);
        if composition.draws_clipped_cracks() {
            geometry.to_mut().clip_cracks(self.scene, self.request.view.frame);
        }
        let mut thickness_ms = None;
        if composition.reads_thickness() {
            let started = Instant::now();
            geometry.to_mut().bodies.measure_thickness();
            thickness_ms = Some(started.elapsed().as_secs_f64() * 1e3);
        }
        let viewed = Viewed {
            geometry: &geometry,
            environment: &self.scene.environment,
            camera: &self.camera,
            eta_outside: self.scene.media[0].eta.get(),
            resolution_px: part.resolution_px(),
        };
        let frame = Frame::new(self.gpu, &allocator, &composition, &viewed)?;
        let mut executed = self.once(&frame, false, true)?;
        if part.is_timed() {
            // The frames after the first are what a game draws.
            executed = self.once(&frame, false, false)?;
        }
        Ok(Ran { composition, allocator, frame, executed, thickness_ms })
    }

    fn once(&self, frame: &Frame, timed: bool, first: bool) -> Result<Executed, Error> {
        let mut recorder = Recorder::new(self.gpu, timed);
        frame.record(&mut recorder, first);
        recorder.finish()
    }

    fn read_radiance(&self, ran: &Ran<'_>, k: u32, layers: &mut Layers) -> Result<(), Error> {
        let values = self.read(ran, "radiance")?;
        let [width, height] = self.request.view.resolution_px.map(|n| n as usize);
        let k = k as usize;
        let stride = width * k;
        let mut radiance = vec![0.0; 3 * width * height];
        let mut coverage = vec![0.0; width * height];
        for y in 0..height * k {
            for x in 0..stride {
                let from = 4 * (y * stride + x);
                let pixel = y / k * width + x / k;
                for channel in 0..3 {
                    radiance[3 * pixel + channel] += f64::from(values[from + channel]);
                }
                coverage[pixel] += f64::from(values[from + 3]);
            }
        }
        let positions = (k * k) as f64;
        radiance.iter_mut().chain(&mut coverage).for_each(|value| *value /= positions);
        self.push(layers, LayerName::Radiance, 3, radiance);
        self.push(layers, LayerName::Coverage, 1, coverage);
        Ok(())
    }

    fn read_single(
        &self,
        ran: &Ran<'_>,
        request: &Request,
        layers: &mut Layers,
    ) -> Result<(), Error> {
        for (output, name) in
            [("exit", LayerName::Exit), ("first", LayerName::First), ("hit2", LayerName::Hit2)]
        {
            if ran.composition.outputs.contains(&output) {
                let values = self.read(ran, output)?;
                let centre =
                    if output == "hit2" { self.geometry.centre.to_array() } else { [0.0; 3] };
                let texels = values.chunks_exact(4);
                let vectors = texels.flat_map(|v| {
                    let written = f64::from(v[3]);
                    [0, 1, 2].map(|i| (f64::from(v[i]) + centre[i]) * written)
                });
                self.push(layers, name, 3, vectors.collect());
            }
        }
        if ran.composition.outputs.contains(&"count") {
            let values = self.read(ran, "count")?;
            let channel = |i: usize| values.chunks_exact(4).map(|v| f64::from(v[i])).collect();
            self.push(layers, LayerName::Events, 1, channel(0));
            self.push(layers, LayerName::Flags, 1, channel(1));
            for layer in &self.request.view.layers {
                if let LayerName::Path(_) = layer {
                    self.push(layers, layer.clone(), 1, channel(2));
                }
            }
        }
        self.read_buffers(ran, request, layers)
    }

    fn read_buffers(
        &self,
        ran: &Ran<'_>,
        request: &Request,
        layers: &mut Layers,
    ) -> Result<(), Error> {
        for name in buffers(request) {
            let nothing_drawn = name == "crack_mask" && ran.composition.interior.is_none();
            let values = if nothing_drawn {
                vec![0.0; layers.pixels()]
            } else if let (Some(part), Some(counted)) = (LayerPart::named(name), ran.frame.layers())
            {
                let of = (layers.pixels(), self.geometry.nested);
                part.read(self.gpu, &ran.frame.resources, counted, of)?
            } else if name == "thickness" {
                let (front, back) = (self.read(ran, "front_depth")?, self.read(ran, "back_depth")?);
                back.iter().zip(&front).map(|(b, f)| f64::from((b - f).max(0.0))).collect()
            } else {
                self.read(ran, name)?.into_iter().map(f64::from).collect::<Vec<_>>()
            };
            let channels = values.len() / layers.pixels();
            let (channels, values) = if channels == 4 {
                let vectors = values.chunks_exact(4).flat_map(|v| [v[0], v[1], v[2]]);
                (3, vectors.collect())
            } else {
                (channels, values)
            };
            self.push(layers, LayerName::Buffer(name.to_owned()), channels, values);
        }
        Ok(())
    }

    fn read(&self, ran: &Ran<'_>, name: &str) -> Result<Vec<f32>, Error> {
        let texture = ran.frame.resources.image(name).ok_or_else(|| Error::UnknownLayer {
            method: self.method.id.to_owned(),
            layer: name.to_owned(),
            available: BUFFERS.join(", "),
        })?;
        let channels = if texture.format() == wgpu::TextureFormat::R32Float { 1 } else { 4 };
        readback::texture_values(self.gpu, texture, channels)
    }

    /// Keeps a layer if it was asked for.
    fn push(&self, layers: &mut Layers, name: LayerName, channels: usize, data: Vec<f64>) {
        if self.request.view.wants(&name) && layers.get(&name).is_none() {
            layers.push(name, channels, data);
        }
    }

    fn answer(&self, done: Done, plan: Plan, layers: Layers) -> Rendering {
        let info = self.gpu.info();
        let counters = [
            ("passes", done.count),
            ("bytes", done.bytes),
            ("triangles", self.geometry.bodies.corners.len() as u64 / 3),
            ("timed_frames", done.timed_frames),
            ("layers", done.layers),
            ("layer_bytes", done.layer_bytes),
        ];
        Rendering {
            layers,
            passes: done.passes,
            counters: counters.map(|(name, value)| (name.to_owned(), value)).into(),
            plan,
            provenance: Provenance {
                renderer: self.method.id.to_owned(),
                parameters: self.settings.describe(),
                adapter: info.name.clone(),
                driver: info.driver.clone(),
                software: info.software,
                seed: None,
                version: env!("CARGO_PKG_VERSION").to_owned(),
            },
        }
    }

    fn time(&self, frame: &Frame, timing: Timing) -> Result<Vec<Executed>, Error> {
        for _ in 0..timing.warm_up {
            self.once(frame, true, false)?;
        }
        let started = Instant::now();
        let mut frames = Vec::new();
        while frames.len() < 3
            || (started.elapsed().as_secs_f64() < timing.seconds
                && frames.len() < timing.max_frames as usize)
        {
            frames.push(self.once(frame, true, false)?);
        }
        Ok(frames)
    }
}

struct Ran<'a> {
    composition: Composition,
    allocator: Allocator<'a>,
    frame: Frame,
    executed: Executed,
    /// What it took to find the distances through the bodies, if they are read.
    thickness_ms: Option<f64>,
}

/// What all frames of a request did, as the recorder and the allocator saw it.
#[derive(Default)]
struct Done {
    passes: Vec<Pass>,
    count: u64,
    bytes: u64,
    timed_frames: u64,
    layers: u64,
    layer_bytes: u64,
}

impl Done {
    /// Layers per pixel that are kept, and their bytes, in the frame that keeps
    /// the most.
    fn layers(&mut self, counted: Option<Counted>, part: &Part) {
        let layers = counted.map_or(0, |counted| u64::from(counted.capacity));
        let pixels: u64 = part.resolution_px().map(u64::from).iter().product();
        self.layers = self.layers.max(layers);
        self.layer_bytes = self.layer_bytes.max(8 * layers * pixels);
    }

    /// `thickness_ms`: what the CPU did before the frame, and would before every
    /// other.
    fn add(
        &mut self,
        label: &str,
        executed: &[String],
        timed: &[Executed],
        thickness_ms: Option<f64>,
    ) {
        self.count += executed.len() as u64;
        self.timed_frames += timed.len() as u64;
        if let Some(milliseconds) = thickness_ms {
            self.count += 1;
            let times = vec![Time { source: TimeSource::Cpu, milliseconds }];
            self.passes.push(Pass { name: format!("{label}{THICKNESS}"), times });
        }
        let passes = executed.iter().enumerate();
        self.passes.extend(passes.map(|(index, name)| Pass {
            name: format!("{label}{name}"),
            times: timestamp(timed, index),
        }));
        if !timed.is_empty() {
            let frame_ms = median(timed.iter().map(|frame| frame.wall_ms));
            let milliseconds = frame_ms + thickness_ms.unwrap_or(0.0);
            let times = vec![Time { source: TimeSource::Wall, milliseconds }];
            self.passes.push(Pass { name: format!("{label}{WHOLE_FRAME}"), times });
        }
    }
}

/// Finding the distances along the normals, on the CPU.
pub(crate) const THICKNESS: &str = "distances along normals";
/// Label of the frame that is timed, and name of the entry with its wall time.
const TIMED: &str = "timed: ";
const WHOLE_FRAME: &str = "frame";

/// One frame of a request.
pub(crate) struct Part {
    /// Before the names of its passes; empty for the first.
    pub(crate) label: &'static str,
    /// The request, reduced to what this frame answers.
    pub(crate) request: Request,
    /// Images that shading writes.
    pub(crate) outputs: Vec<&'static str>,
    /// Texels along a pixel's side.
    pub(crate) scale: u32,
}

impl Part {
    pub(crate) fn is_timed(&self) -> bool {
        self.label == TIMED
    }

    /// Pixels of its images.
    pub(crate) fn resolution_px(&self) -> [u32; 2] {
        self.request.view.resolution_px.map(|n| n * self.scale)
    }

    /// Samplers read 32-bit floats only where the adapter can; elsewhere the
    /// manual filter is what can be timed.
    fn on(mut self, gpu: &Gpu) -> Self {
        if !gpu.device.features().contains(wgpu::Features::FLOAT32_FILTERABLE) {
            self.request.filter = Filter::Manual;
        }
        self
    }
}

/// The frames that a request comes to: light at k x k positions, layers at
/// pixel centres (together with the light where k is 1), and the frame that is
/// timed, which is what a game would draw: light only, one position, the
/// hardware's filter.
pub(crate) fn parts(request: &Request, outputs: &[&'static str]) -> Vec<Part> {
    let k = request.view.positions_per_axis;
    let reduced = |keep: fn(&LayerName) -> bool, filter| {
        let layers = request.view.layers.iter().filter(|layer| keep(layer)).cloned().collect();
        Request { view: View { layers, ..request.view.clone() }, filter, ..request.clone() }
    };
    let mut parts = Vec::new();
    let light = || vec!["radiance"];
    if outputs.contains(&"radiance") && k > 1 {
        let request = reduced(is_light, request.filter);
        parts.push(Part { label: "", request, outputs: light(), scale: k });
    }
    let single = outputs.iter().copied().filter(|output| k == 1 || *output != "radiance");
    let single: Vec<_> = single.collect();
    if !single.is_empty() || !buffers(request).is_empty() || parts.is_empty() {
        let label = if parts.is_empty() { "" } else { "centre: " };
        let request = reduced(|_| true, request.filter);
        parts.push(Part { label, request, outputs: single, scale: 1 });
    }
    if request.timing.is_some() {
        let request = reduced(is_light, Filter::Hardware);
        parts.push(Part { label: TIMED, request, outputs: light(), scale: 1 });
    }
    parts
}

fn is_light(layer: &LayerName) -> bool {
    matches!(layer, LayerName::Radiance | LayerName::Coverage)
}

/// Names of the intermediate buffers that were asked for.
fn buffers(request: &Request) -> Vec<&str> {
    let names = request.view.layers.iter().filter_map(|layer| match layer {
        LayerName::Buffer(name) => Some(name.as_str()),
        _ => None,
    });
    names.collect()
}

/// Most texels along a side that any adapter is asked for.
const LARGEST_PX: u64 = 32_768;

/// Refuses sizes that have no content, or that no adapter holds.
fn check_size(request: &Request) -> Result<(), Error> {
    let [width, height] = request.view.resolution_px;
    let k = request.view.positions_per_axis;
    let what = format!("an image of {width} x {height} pixels with {k} x {k} positions");
    let needed = u64::from(width.max(height)) * u64::from(k);
    if width == 0 || height == 0 || k == 0 {
        return Err(Error::Size(format!("{what} is empty; write at least 1 for each")));
    }
    if needed > LARGEST_PX {
        let advice = "lower the resolution or the number of positions";
        return Err(Error::Size(format!(
            "{what} is {needed} texels along a side, more than {LARGEST_PX}; {advice}"
        )));
    }
    Ok(())
}

/// Intermediate buffers that can be asked for as layers.
pub(crate) const BUFFERS: [&str; 7] = [
    "front_normal",
    "front_depth",
    "front_geometric",
    "back_normal",
    "back_depth",
    "thickness",
    "crack_mask",
];

/// The scene's camera at the resolution that was asked for.
pub(crate) fn camera(scene: &Scene, request: &Request) -> Camera {
    Camera { resolution_px: request.view.resolution_px, ..scene.camera }
}

/// Images that the shading pass must write.
pub(crate) fn outputs(method: &Method, request: &Request) -> Result<Vec<&'static str>, Error> {
    check_size(request)?;
    let mut outputs = Vec::new();
    for layer in &request.view.layers {
        let output = match layer {
            LayerName::Radiance | LayerName::Coverage => "radiance",
            LayerName::Exit => "exit",
            LayerName::First => "first",
            LayerName::Hit2 => "hit2",
            LayerName::Events | LayerName::Flags | LayerName::Path(_) => "count",
            LayerName::Buffer(name)
                if BUFFERS.contains(&name.as_str()) || LayerPart::named(name).is_some() =>
            {
                continue;
            }
            other => {
                return Err(Error::UnknownLayer {
                    method: method.id.to_owned(),
                    layer: other.to_string(),
                    available: format!(
                        "radiance, coverage, exit, first, hit2, events, flags, path.<medium>, {}, \
                         layer_count, layer_depth.<n>, layer_normal.<n>, layer_facing.<n>",
                        BUFFERS.join(", ")
                    ),
                });
            }
        };
        if !outputs.contains(&output) {
            outputs.push(output);
        }
    }
    Ok(outputs)
}

fn timestamp(frames: &[Executed], pass: usize) -> Vec<Time> {
    let values: Vec<f64> =
        frames.iter().filter_map(|frame| frame.timestamp_ms.as_ref()?.get(pass).copied()).collect();
    if values.is_empty() {
        return Vec::new();
    }
    vec![Time { source: TimeSource::Timestamp, milliseconds: median(values.into_iter()) }]
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) }
}
