//! The frames that a request comes to.

use crate::composition::outputs::buffers;
use crate::gpu::Gpu;
use crate::request::Filter;
use crate::request::Request;
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
    /// Texels along a pixel's side.
    pub(crate) scale: u32,
}

impl FrameRequest {
    pub(crate) fn is_timed(&self) -> bool {
        self.label == TIMED
    }

    /// Pixels of its images.
    pub(crate) fn resolution_px(&self) -> [u32; 2] {
        self.request.view.resolution_px.map(|n| n * self.scale)
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
/// timed, which is what a game would draw: light only, one position, the
/// hardware's filter.
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
        frames.push(FrameRequest { label: "", request, outputs: light(), scale: k });
    }
    let single = outputs.iter().copied().filter(|output| k == 1 || *output != "radiance");
    let single: Vec<_> = single.collect();
    let nothing_else = frames.is_empty() && request.timing.is_none();
    if !single.is_empty() || !buffers(request).is_empty() || nothing_else {
        let label = if frames.is_empty() { "" } else { "centre: " };
        let request = reduced(|_| true, request.filter);
        frames.push(FrameRequest { label, request, outputs: single, scale: 1 });
    }
    if request.timing.is_some() {
        let request = reduced(is_light, Filter::Hardware);
        frames.push(FrameRequest { label: TIMED, request, outputs: light(), scale: 1 });
    }
    frames
}

fn is_light(layer: &LayerName) -> bool {
    matches!(layer, LayerName::Radiance | LayerName::Coverage)
}
