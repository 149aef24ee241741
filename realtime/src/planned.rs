//! What a request comes to: its plan.

use crate::asked::Asked;
use crate::composition::layer_images::LayerImage;
use crate::composition::outputs::outputs;
use crate::error::Error;
use crate::frame::Composition;
use crate::frames::frames;
use crate::gpu::Gpu;
use crate::gpu::readback::PIECE_BYTES;
use crate::methods::{Method, Settings};
use crate::passes::peel;
use crate::request::Request;
use scenes::plan::Buffer;
use scenes::{LayerName, Plan, Scene, View};

/// What a method will do with a scene on any adapter. What only an adapter can tell
/// is left open: layers are not counted, and their bytes are stated for one.
///
/// # Errors
/// If the method, a parameter or a layer is unknown.
pub fn plan(scene: &Scene, request: &Request) -> Result<Plan, Error> {
    let method = Method::find(&request.method)?;
    let settings = Settings::new(method, &request.parameters)?;
    Asked::new(scene, request, method, &settings)?.plan(None)
}

/// What a method will do with a scene on an adapter, decided as [`crate::render`]
/// does it: by its features and limits, with the layers of the view counted.
///
/// # Errors
/// Those of [`crate::render`]: also if the adapter does not allow what is needed.
pub fn plan_on(gpu: &Gpu, scene: &Scene, request: &Request) -> Result<Plan, Error> {
    let method = Method::find(&request.method)?;
    let mut settings = Settings::new(method, &request.parameters)?;
    peel::decide(&mut settings, gpu);
    let asked = Asked::new(scene, request, method, &settings)?;
    gpu.scoped(|| asked.plan(Some(gpu)))
}

impl Asked<'_> {
    fn plan(&self, gpu: Option<&Gpu>) -> Result<Plan, Error> {
        let mut plan = Plan::default();
        for mut frame in frames(self.request, &outputs(self.method, self.scene, self.request)?) {
            frame = match gpu {
                Some(gpu) => frame.on(gpu),
                None => frame,
            };
            let composition = Composition::new(self.inputs(&frame))?;
            let geometry = self.drawn(&composition);
            let shifts = frame.shifts();
            let mut counted = None;
            if let Some(gpu) = gpu {
                composition.check(gpu, None)?;
                let view = self.viewed(&geometry, shifts[0]);
                counted = composition.count(gpu, &view, &shifts)?;
                composition.check(gpu, counted)?;
            }
            let of_frame = composition.plan(&geometry, shifts.len(), frame.is_timed(), counted);
            add(&mut plan, frame.label, of_frame);
        }
        plan.peak_bytes += bytes_of_layers(&self.request.view);
        Ok(plan)
    }
}

/// Of the layers that are handed over: 64 bits for each number.
pub(crate) fn bytes_of_layers(view: &View) -> u64 {
    let vectors = ["front_normal", "front_geometric", "back_normal"];
    let channels = |layer: &LayerName| match layer {
        LayerName::Radiance | LayerName::Exit | LayerName::First | LayerName::Hit2 => 3,
        LayerName::Buffer(name) if vectors.contains(&name.as_str()) => 3,
        LayerName::Buffer(name) => match LayerImage::named(name) {
            Some(LayerImage::Normal(_)) => 3,
            _ => 1,
        },
        _ => 1,
    };
    let numbers: u64 = view.layers.iter().map(channels).sum();
    8 * numbers * view.resolution_px.map(u64::from).iter().product::<u64>()
}

/// Adds a frame to a plan. What is left out is told once, for the first.
pub(crate) fn add(plan: &mut Plan, label: &str, of_frame: Plan) {
    // One frame after the other: the largest decides.
    let peak_bytes = plan.peak_bytes.max(of_frame.bytes() + PIECE_BYTES);
    if label.is_empty() {
        *plan = Plan { peak_bytes, ..of_frame };
        return;
    }
    plan.peak_bytes = peak_bytes;
    let labelled = |name: &str| format!("{label}{name}");
    plan.passes.extend(of_frame.passes.iter().map(|name| labelled(name)));
    let buffers = of_frame.buffers.iter();
    let labelled = buffers.map(|b| Buffer { name: labelled(&b.name), bytes: b.bytes });
    plan.buffers.extend(labelled);
}
