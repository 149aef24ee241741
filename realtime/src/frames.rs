//! The frames that a request comes to.

use crate::composition::outputs::buffers;
use crate::gpu::Gpu;
use crate::request::{Filter, Request, Timing};
use glam::DVec2;
use scenes::{LayerName, View};

/// Label of the frame that is timed.
pub(crate) const TIMED: &str = "timed: ";

/// One frame of a request.
pub(crate) struct FrameRequest {
    /// Before the names of its passes; empty for the first.
    pub(crate) label: &'static str,
    /// The request, reduced to what this frame answers.
    pub(crate) request: Request,
    /// Images that shading writes.
    pub(crate) outputs: Vec<&'static str>,
    /// k: it is drawn at k x k positions in each pixel.
    pub(crate) positions_per_axis: u32,
}

impl FrameRequest {
    pub(crate) fn is_timed(&self) -> bool {
        self.label == TIMED
    }

    /// Where in the pixels it is drawn, as [`Viewed::shift`]: ((i + ½)/k, (j + ½)/k),
    /// rows first. A pixel's centre is no shift at all.
    ///
    /// [`Viewed::shift`]: crate::drawn::frame_uniforms::Viewed
    pub(crate) fn shifts(&self) -> Vec<DVec2> {
        let k = self.positions_per_axis;
        let size = DVec2::from_array(self.request.view.resolution_px.map(f64::from));
        let from_centre = |i: u32| (f64::from(i) + 0.5) / f64::from(k) - 0.5;
        let shift = |n: u32| DVec2::new(from_centre(n % k), from_centre(n / k)) / size;
        (0..k * k).map(shift).collect()
    }

    /// Samplers read 32-bit floats only where the adapter can; elsewhere the
    /// manual filter is what can be timed.
    pub(crate) fn on(mut self, gpu: &Gpu) -> Self {
        if !gpu.device.features().contains(wgpu::Features::FLOAT32_FILTERABLE) {
            self.request.filter = Filter::Manual;
        }
        self
    }
}

/// The frames that a request comes to: light at k x k positions, layers at
/// pixel centres (together with the light where k is 1), and the frame that is
/// timed, which is what a game would draw: light only, one position unless more
/// are asked for, the hardware's filter.
///
/// Each position is a frame of the image's own size, seen by a camera that is
/// shifted within the pixel, so that a method sees the surfaces as finely in an
/// image that is judged as in the one that is timed, and k x k positions need the
/// memory of one.
pub(crate) fn frames(request: &Request, outputs: &[&'static str]) -> Vec<FrameRequest> {
    let k = request.view.positions_per_axis;
    let reduced = |keep: fn(&LayerName) -> bool, filter| {
        let layers = request.view.layers.iter().filter(|layer| keep(layer)).cloned().collect();
        Request { view: View { layers, ..request.view.clone() }, filter, ..request.clone() }
    };
    let mut frames = Vec::new();
    let light = || vec!["radiance"];
    if outputs.contains(&"radiance") && k > 1 {
        let request = reduced(is_light, request.filter);
        frames.push(FrameRequest { label: "", request, outputs: light(), positions_per_axis: k });
    }
    let single = outputs.iter().copied().filter(|output| k == 1 || *output != "radiance");
    let single: Vec<_> = single.collect();
    let nothing_else = frames.is_empty() && request.timing.is_none();
    if !single.is_empty() || !buffers(request).is_empty() || nothing_else {
        let label = if frames.is_empty() { "" } else { "centre: " };
        let request = reduced(|_| true, request.filter);
        frames.push(FrameRequest { label, request, outputs: single, positions_per_axis: 1 });
    }
    if let Some(Timing { positions_per_axis, .. }) = request.timing {
        let request = reduced(is_light, Filter::Hardware);
        frames.push(FrameRequest { label: TIMED, request, outputs: light(), positions_per_axis });
    }
    frames
}

fn is_light(layer: &LayerName) -> bool {
    matches!(layer, LayerName::Radiance | LayerName::Coverage)
}
