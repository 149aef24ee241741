//! A method's image of a scene.

use crate::composition::{Composition, Filter};
use crate::frame::{Frame, Viewed};
use crate::geometry::Geometry;
use crate::method::{Method, Settings};
use crate::recorder::{Allocator, Executed, Recorder};
use crate::{Error, Gpu, plan, readback};
use scenes::rendering::{Pass, Provenance, Time, TimeSource};
use scenes::{Camera, LayerName, Layers, Rendering, Scene, View};
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
/// direction layers come from a frame of their own at pixel centres.
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
        let k = self.request.view.positions_per_axis.max(1);
        let colour = wanted.contains(&"radiance");
        let single: Vec<_> =
            wanted.iter().copied().filter(|output| k == 1 || *output != "radiance").collect();
        let mut ran = None;
        if colour && k > 1 {
            let run = self.frame(vec!["radiance"], k)?;
            self.read_radiance(&run, k, &mut layers)?;
            ran = Some(run);
        }
        if !single.is_empty() || !self.buffers().is_empty() {
            let run = self.frame(single, 1)?;
            self.read_single(&run, k == 1, &mut layers)?;
            ran = ran.or(Some(run));
        }
        let ran = match ran {
            Some(ran) => ran,
            None => self.frame(Vec::new(), 1)?,
        };
        self.answer(&ran, layers)
    }

    fn frame(&self, outputs: Vec<&'static str>, scale: u32) -> Result<Ran<'_>, Error> {
        let composition = Composition::new(
            self.method,
            self.settings,
            self.scene,
            &self.camera,
            self.geometry,
            self.request,
            outputs,
        )?;
        let allocator = Allocator::new(self.gpu);
        let mut measured = None;
        let geometry = if composition.reads_thickness() {
            let mut geometry = self.geometry.clone();
            geometry.measure_thickness();
            measured.insert(geometry)
        } else {
            self.geometry
        };
        let viewed = Viewed {
            geometry,
            environment: &self.scene.environment,
            camera: &self.camera,
            eta_outside: self.scene.media[0].eta.get(),
            resolution_px: self.request.view.resolution_px.map(|n| n * scale),
        };
        let frame = Frame::new(self.gpu, &allocator, &composition, &viewed)?;
        let executed = self.once(&frame, false)?;
        Ok(Ran { composition, allocator, frame, executed })
    }

    fn once(&self, frame: &Frame, timed: bool) -> Result<Executed, Error> {
        let mut recorder = Recorder::new(self.gpu, timed);
        frame.record(&mut recorder);
        recorder.finish()
    }

    /// Names of the intermediate buffers that were asked for.
    fn buffers(&self) -> Vec<&str> {
        let names = self.request.view.layers.iter().filter_map(|layer| match layer {
            LayerName::Buffer(name) => Some(name.as_str()),
            _ => None,
        });
        names.collect()
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

    fn read_single(&self, ran: &Ran<'_>, colour: bool, layers: &mut Layers) -> Result<(), Error> {
        if colour && ran.composition.outputs.contains(&"radiance") {
            self.read_radiance(ran, 1, layers)?;
        }
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
        self.read_buffers(ran, layers)
    }

    fn read_buffers(&self, ran: &Ran<'_>, layers: &mut Layers) -> Result<(), Error> {
        for name in self.buffers() {
            let values = if name == "thickness" {
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

    fn answer(&self, ran: &Ran<'_>, layers: Layers) -> Result<Rendering, Error> {
        let timed = match self.request.timing {
            Some(timing) => self.time(&ran.frame, timing)?,
            None => Vec::new(),
        };
        let mut passes: Vec<Pass> = ran
            .executed
            .passes
            .iter()
            .enumerate()
            .map(|(index, name)| Pass { name: name.clone(), times: timestamp(&timed, index) })
            .collect();
        if !timed.is_empty() {
            let wall_ms = median(timed.iter().map(|frame| frame.wall_ms));
            passes.push(Pass {
                name: "frame".to_owned(),
                times: vec![Time { source: TimeSource::Wall, milliseconds: wall_ms }],
            });
        }
        let bytes = ran.allocator.allocated().iter().map(|buffer| buffer.bytes).sum();
        let info = self.gpu.info();
        let counters = [
            ("passes", ran.executed.passes.len() as u64),
            ("bytes", bytes),
            ("triangles", self.geometry.corners.len() as u64 / 3),
            ("timed_frames", timed.len() as u64),
        ];
        Ok(Rendering {
            layers,
            passes,
            counters: counters.map(|(name, value)| (name.to_owned(), value)).into(),
            plan: plan::of(
                &ran.composition,
                self.scene,
                self.geometry,
                self.request,
                ran.frame.layers(),
            ),
            provenance: Provenance {
                renderer: self.method.id.to_owned(),
                parameters: self.settings.describe(),
                adapter: info.name.clone(),
                driver: info.driver.clone(),
                software: info.software,
                seed: None,
                version: env!("CARGO_PKG_VERSION").to_owned(),
            },
        })
    }

    fn time(&self, frame: &Frame, timing: Timing) -> Result<Vec<Executed>, Error> {
        for _ in 0..timing.warm_up {
            self.once(frame, true)?;
        }
        let started = Instant::now();
        let mut frames = Vec::new();
        while frames.len() < 3
            || (started.elapsed().as_secs_f64() < timing.seconds
                && frames.len() < timing.max_frames as usize)
        {
            frames.push(self.once(frame, true)?);
        }
        Ok(frames)
    }
}

struct Ran<'a> {
    composition: Composition,
    allocator: Allocator<'a>,
    frame: Frame,
    executed: Executed,
}

/// Intermediate buffers that can be asked for as layers.
pub(crate) const BUFFERS: [&str; 6] =
    ["front_normal", "front_depth", "front_geometric", "back_normal", "back_depth", "thickness"];

/// The scene's camera at the resolution that was asked for.
pub(crate) fn camera(scene: &Scene, request: &Request) -> Camera {
    Camera { resolution_px: request.view.resolution_px, ..scene.camera }
}

/// Images that the shading pass must write.
pub(crate) fn outputs(method: &Method, request: &Request) -> Result<Vec<&'static str>, Error> {
    let mut outputs = Vec::new();
    for layer in &request.view.layers {
        let output = match layer {
            LayerName::Radiance | LayerName::Coverage => "radiance",
            LayerName::Exit => "exit",
            LayerName::First => "first",
            LayerName::Hit2 => "hit2",
            LayerName::Events | LayerName::Flags | LayerName::Path(_) => "count",
            LayerName::Buffer(name) if BUFFERS.contains(&name.as_str()) => continue,
            other => {
                return Err(Error::UnknownLayer {
                    method: method.id.to_owned(),
                    layer: other.to_string(),
                    available: format!(
                        "radiance, coverage, exit, first, hit2, events, flags, path.<medium>, {}",
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
