//! What a request comes to: its image.

use crate::asked::Asked;
use crate::composition::outputs::outputs;
use crate::drawing::Drawing;
use crate::error::Error;
use crate::frame::{Composition, Frame};
use crate::frames::{FrameRequest, frames};
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::recorder::Executed;
use crate::methods::{Method, Settings};
use crate::passes::peel;
use crate::plan::counted::Counted;
use crate::plan::timing::{FrameTimes, REFIT, THICKNESS};
use crate::planned::{self, add};
use crate::readout::{Light, Readout};
use crate::request::Request;
use scenes::rendering::Provenance;
use scenes::{Layers, Plan, Rendering, Scene};
use std::time::Instant;

/// Renders a scene with a method.
///
/// Radiance is the mean of k x k frames, each seen through another position in the
/// pixels; the direction layers come from a frame of their own at pixel centres.
/// What is timed is one more: one position per pixel unless [`crate::Timing`] says
/// otherwise, light only, filtered by the hardware.
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

/// A frame that was rendered.
struct Ran {
    plan: Plan,
    /// Of everything that was allocated.
    bytes: u64,
    counted: Option<Counted>,
    /// Names of the passes.
    executed: Vec<String>,
    timed: Vec<Executed>,
    /// What it took to find the distances through the bodies, if they are read.
    thickness_ms: Option<f64>,
    /// What it took to refit the tree that rays search, if they do and it has moved.
    refit_ms: Option<f64>,
}

impl Asked<'_> {
    fn run(&self, gpu: &Gpu, wanted: &[&'static str]) -> Result<Rendering, Error> {
        let mut layers = Layers::new(self.request.view.resolution_px);
        let mut times = FrameTimes::default();
        let mut plan = Plan::default();
        for request in frames(self.request, wanted) {
            let request = request.on(gpu);
            let ran = self.frame(gpu, &request, &mut layers)?;
            ran.counted.into_iter().for_each(|counted| times.layers(counted));
            times.bytes += ran.bytes;
            let thickness_ms = ran.thickness_ms.filter(|_| self.geometry.deforms);
            let on_cpu = [(REFIT, ran.refit_ms), (THICKNESS, thickness_ms)];
            times.add(request.label, &ran.executed, &ran.timed, &on_cpu);
            add(&mut plan, request.label, ran.plan);
        }
        plan.peak_bytes += planned::bytes_of_layers(&self.request.view);
        Ok(self.answer(gpu, times, plan, layers))
    }

    fn frame(&self, gpu: &Gpu, request: &FrameRequest, layers: &mut Layers) -> Result<Ran, Error> {
        let composition = Composition::new(self.inputs(request))?;
        composition.check(gpu, None)?;
        let allocator = Allocator::new(gpu);
        let mut geometry = self.drawn(&composition);
        let mut thickness_ms = None;
        if composition.reads_thickness() {
            let started = Instant::now();
            geometry.to_mut().bodies.measure_thickness();
            thickness_ms = Some(started.elapsed().as_secs_f64() * 1e3);
        }
        let shifts = request.shifts();
        let view = self.viewed(&geometry, shifts[0]);
        let frame = Frame::new(gpu, &allocator, &composition, &view, &shifts)?;
        let drawing = Drawing { gpu, frame: &frame, view, shifts: &shifts };
        let (executed, timed) = match self.request.timing.filter(|_| request.is_timed()) {
            Some(timing) => drawing.timed(timing)?,
            None => (self.judged(gpu, request, &drawing, layers)?.passes, Vec::new()),
        };
        let counted = frame.counted();
        let plan = composition.plan(&geometry, shifts.len(), request.is_timed(), counted);
        let bytes = allocator.allocated().iter().map(|buffer| buffer.bytes).sum();
        let refit_ms = composition.follows_rays().then(|| geometry.rays().refit_ms).flatten();
        Ok(Ran { plan, bytes, counted, executed, timed, thickness_ms, refit_ms })
    }

    /// Draws an image and reads its layers.
    fn judged(
        &self,
        gpu: &Gpu,
        request: &FrameRequest,
        drawing: &Drawing<'_>,
        layers: &mut Layers,
    ) -> Result<Executed, Error> {
        let (method, geometry, view) = (self.method, &self.geometry, &self.request.view);
        let readout = Readout { gpu, method, geometry, view, frame: drawing.frame };
        let mut light = request.outputs.contains(&"radiance").then(|| Light::of(view));
        let executed = drawing.once(false, true, || {
            light.as_mut().map_or(Ok(()), |light| readout.add_light(light))
        })?;
        if let Some(light) = light {
            light.keep(drawing.shifts.len(), layers);
        }
        if request.positions_per_axis == 1 {
            readout.at_centres(request, layers)?;
        }
        Ok(executed)
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
                seed: self.settings.seed(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
            },
        }
    }
}
