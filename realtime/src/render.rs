//! A method's image of a scene.

use crate::composition::inputs::Order;
use crate::composition::outputs::{BUFFERS, buffers, camera, outputs};
use crate::drawn::frame_uniforms::Viewed;
use crate::drawn::geometry::Geometry;
use crate::frame::Frame;
use crate::frames::{Part, TIMED, parts};
use crate::gpu::readback;
use crate::gpu::recorder::{Allocator, Executed, Recorder};
use crate::methods::{Method, Settings};
use crate::passes::Composition;
use crate::passes::peel::{self, LayerPart};
use crate::plan::timing::Done;
use crate::request::{Request, Timing};
use crate::{Error, Gpu, plan};
use rayon::prelude::*;
use scenes::rendering::Provenance;
use scenes::{Camera, LayerName, Layers, Plan, Rendering, Scene};
use std::borrow::Cow;
use std::time::Instant;

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
    let mut settings = Settings::new(method, &request.parameters)?;
    peel::decide(&mut settings, gpu);
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
            done.layers(layers_held, ran.composition.peel.as_ref());
            done.bytes += ran.allocator.allocated().iter().map(|buffer| buffer.bytes).sum::<u64>();
            let timed = match (part.label, self.request.timing) {
                (TIMED, Some(timing)) => self.time(&ran, timing)?,
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
            executed = self.once(&frame, true, false)?;
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
        let mut radiance = vec![0.0; 3 * width * height];
        let mut coverage = vec![0.0; width * height];
        let rows = radiance.par_chunks_mut(3 * width).zip(coverage.par_chunks_mut(width));
        rows.zip(values.par_chunks(4 * width * k * k)).for_each(
            |((radiance, coverage), values)| {
                for (i, value) in values.chunks_exact(4).enumerate() {
                    let pixel = i % (width * k) / k;
                    for channel in 0..3 {
                        radiance[3 * pixel + channel] += f64::from(value[channel]);
                    }
                    coverage[pixel] += f64::from(value[3]);
                }
            },
        );
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

    /// Times of frames after the two that were drawn already.
    fn time(&self, ran: &Ran<'_>, timing: Timing) -> Result<Vec<Executed>, Error> {
        let frame = &ran.frame;
        for _ in 2..timing.warm_up {
            self.once(frame, true, false)?;
        }
        let started = Instant::now();
        let mut frames = Vec::new();
        if timing.warm_up < 2 {
            frames.push(ran.executed.clone());
        }
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
