//! What a request comes to: its plan, and its image.

use crate::composition::inputs::Inputs;
use crate::composition::outputs::{camera, outputs};
use crate::drawn::frame_uniforms::Viewed;
use crate::drawn::geometry::Geometry;
use crate::error::Error;
use crate::frame::{Composition, Frame};
use crate::frames::{FrameRequest, frames};
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::recorder::{Executed, Recorder};
use crate::methods::{Method, Settings};
use crate::passes::peel;
use crate::plan::timing::FrameTimes;
use crate::readout::Readout;
use crate::request::{Request, Timing};
use crate::wgsl::Choices;
use scenes::plan::Buffer;
use scenes::rendering::Provenance;
use scenes::{Camera, Layers, Plan, Rendering, Scene};
use std::borrow::Cow;
use std::time::Instant;

/// What a method will do with a scene.
///
/// # Errors
/// If the method, a parameter or a layer is unknown.
pub fn plan(scene: &Scene, request: &Request) -> Result<Plan, Error> {
    let method = Method::find(&request.method)?;
    let settings = Settings::new(method, &request.parameters)?;
    let asked = Asked::new(scene, request, method, &settings)?;
    let mut plan = Plan::default();
    for frame in frames(request, &outputs(method, scene, request)?) {
        let composition = Composition::new(asked.inputs(&frame))?;
        let geometry = asked.drawn(&composition);
        add(&mut plan, frame.label, composition.plan(&geometry, frame.is_timed(), None));
    }
    Ok(plan)
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
    let mut settings = Settings::new(method, &request.parameters)?;
    peel::decide(&mut settings, gpu);
    let asked = Asked::new(scene, request, method, &settings)?;
    let wanted = outputs(method, scene, request)?;
    gpu.scoped(|| asked.run(gpu, &wanted))
}

/// What was asked for, looked up and checked.
struct Asked<'a> {
    scene: &'a Scene,
    request: &'a Request,
    method: &'static Method,
    settings: &'a Settings,
    geometry: Geometry,
    camera: Camera,
}

/// A frame that was rendered.
struct Ran {
    plan: Plan,
    /// Of everything that was allocated.
    bytes: u64,
    frame: Frame,
    executed: Executed,
    /// What it took to find the distances through the bodies, if they are read.
    thickness_ms: Option<f64>,
}

impl<'a> Asked<'a> {
    fn new(
        scene: &'a Scene,
        request: &'a Request,
        method: &'static Method,
        settings: &'a Settings,
    ) -> Result<Self, Error> {
        let geometry = Geometry::new(scene, request.view.frame)?;
        let camera = camera(scene, request);
        Ok(Self { scene, request, method, settings, geometry, camera })
    }

    fn inputs<'b>(&'b self, frame: &'b FrameRequest) -> Inputs<'b> {
        Inputs {
            method: self.method,
            settings: self.settings,
            scene: self.scene,
            camera: &self.camera,
            geometry: &self.geometry,
            request: &frame.request,
            outputs: &frame.outputs,
            resolution_px: frame.resolution_px(),
            choices: Choices::default(),
            index_matched: false,
        }
    }

    /// The geometry as a frame draws it.
    fn drawn(&self, composition: &Composition<'_>) -> Cow<'_, Geometry> {
        let mut geometry = Cow::Borrowed(&self.geometry);
        if composition.draws_clipped_cracks() {
            geometry.to_mut().clip_cracks(self.scene, self.request.view.frame);
        }
        geometry
    }

    fn run(&self, gpu: &Gpu, wanted: &[&'static str]) -> Result<Rendering, Error> {
        let mut layers = Layers::new(self.request.view.resolution_px);
        let mut times = FrameTimes::default();
        let mut plan = Plan::default();
        for request in frames(self.request, wanted) {
            let request = request.on(gpu);
            let ran = self.frame(gpu, &request)?;
            ran.frame.counted().into_iter().for_each(|counted| times.layers(counted));
            times.bytes += ran.bytes;
            let timed = match (request.is_timed(), self.request.timing) {
                (true, Some(timing)) => time(gpu, &ran, timing)?,
                _ => Vec::new(),
            };
            let per_frame_ms = ran.thickness_ms.filter(|_| self.geometry.deforms);
            times.add(request.label, &ran.executed.passes, &timed, per_frame_ms);
            if !request.is_timed() {
                let (method, geometry) = (self.method, &self.geometry);
                let view = &self.request.view;
                Readout { gpu, method, geometry, view, frame: &ran.frame }
                    .read(&request, &mut layers)?;
            }
            add(&mut plan, request.label, ran.plan);
        }
        Ok(self.answer(gpu, times, plan, layers))
    }

    fn frame(&self, gpu: &Gpu, request: &FrameRequest) -> Result<Ran, Error> {
        let composition = Composition::new(self.inputs(request))?;
        let allocator = Allocator::new(gpu);
        let mut geometry = self.drawn(&composition);
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
            resolution_px: request.resolution_px(),
        };
        let frame = Frame::new(gpu, &allocator, &composition, &viewed)?;
        let mut executed = once(gpu, &frame, false, true)?;
        if request.is_timed() {
            // The frames after the first are what a game draws.
            executed = once(gpu, &frame, true, false)?;
        }
        let plan = composition.plan(&geometry, request.is_timed(), frame.counted());
        let bytes = allocator.allocated().iter().map(|buffer| buffer.bytes).sum();
        Ok(Ran { plan, bytes, frame, executed, thickness_ms })
    }

    fn answer(&self, gpu: &Gpu, times: FrameTimes, plan: Plan, layers: Layers) -> Rendering {
        let info = gpu.info();
        let counters = [
            ("passes", times.count),
            ("bytes", times.bytes),
            ("triangles", self.geometry.bodies.corners.len() as u64 / 3),
            ("timed_frames", times.timed_frames),
            ("layers", times.layers),
            ("layer_bytes", times.layer_bytes),
        ];
        Rendering {
            layers,
            passes: times.passes,
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
}

/// Adds a frame to a plan. What is left out is told once, for the first.
fn add(plan: &mut Plan, label: &str, of_frame: Plan) {
    if label.is_empty() {
        *plan = of_frame;
        return;
    }
    let labelled = |name: &str| format!("{label}{name}");
    plan.passes.extend(of_frame.passes.iter().map(|name| labelled(name)));
    let buffers = of_frame.buffers.iter();
    let labelled = buffers.map(|b| Buffer { name: labelled(&b.name), bytes: b.bytes });
    plan.buffers.extend(labelled);
}

fn once(gpu: &Gpu, frame: &Frame, timed: bool, first: bool) -> Result<Executed, Error> {
    let mut recorder = Recorder::new(gpu, timed);
    frame.record(&mut recorder, first);
    recorder.finish()
}

/// Times of frames after the two that were drawn already.
fn time(gpu: &Gpu, ran: &Ran, timing: Timing) -> Result<Vec<Executed>, Error> {
    let frame = &ran.frame;
    for _ in 2..timing.warm_up {
        once(gpu, frame, true, false)?;
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
        frames.push(once(gpu, frame, true, false)?);
    }
    Ok(frames)
}
