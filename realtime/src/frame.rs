//! The frame, in the order in which it runs. Read this first: [`Frame::record`]
//! is everything that happens on the GPU.

use crate::drawn::frame_uniforms::{Viewed, upload_numbers};
use crate::gpu::environment_upload::upload_environment;
use crate::gpu::recorder::{Allocator, Recorder};
use crate::gpu::resources::Resources;
use crate::passes::Composition;
use crate::passes::backdrop::DrawnBackdrop;
use crate::passes::cracks_and_air::DrawnInterior;
use crate::passes::normal_cube::DrawnNormals;
use crate::passes::peel::{Counted, Peeled};
use crate::passes::pipelines::{DrawnSurfaces, Maker, OverPixels};
use crate::{Error, Gpu};

use wgpu::TextureUsages;

/// Pipelines and memory of a frame, ready to run any number of times.
pub(crate) struct Frame {
    resolution_px: [u32; 2],
    backdrop: Option<DrawnBackdrop>,
    normals: Option<DrawnNormals>,
    front: Option<DrawnSurfaces>,
    back: Option<DrawnSurfaces>,
    peel: Option<Peeled>,
    interior: Option<DrawnInterior>,
    shade: OverPixels,
    pub(crate) resources: Resources,
}

impl Frame {
    /// Everything that happens, in order. What never changes is drawn only in
    /// the first frame.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, first: bool) {
        if let Some(backdrop) = &self.backdrop {
            backdrop.record(recorder, first);
        }
        if let Some(normals) = &self.normals {
            normals.record(recorder, first);
        }
        if let Some(front) = &self.front {
            front.record(recorder, &self.resources);
        }
        if let Some(back) = &self.back {
            back.record(recorder, &self.resources);
        }
        if let Some(peel) = &self.peel {
            peel.record(recorder);
        }
        if let Some(interior) = &self.interior {
            interior.record(recorder);
        }
        self.shade.record(recorder, "shade", self.resolution_px);
    }

    /// Layers per pixel that were counted, if any are collected.
    pub(crate) fn layers(&self) -> Option<Counted> {
        self.peel.as_ref().map(|peel| peel.counted)
    }

    /// Makes pipelines and memory.
    pub(crate) fn new(
        gpu: &Gpu,
        allocator: &Allocator<'_>,
        composition: &Composition,
        view: &Viewed<'_>,
    ) -> Result<Self, Error> {
        let mut resources = Resources::default();
        upload_numbers(allocator, view, &mut resources)?;
        let backdrop = composition
            .backdrop
            .as_ref()
            .map(|backdrop| DrawnBackdrop::new(gpu, allocator, backdrop, view, &mut resources));
        let backdrop = backdrop.transpose()?;
        if backdrop.is_none() {
            let reader = (&composition.shade, "shade");
            upload_environment(gpu, allocator, reader, view.environment, &mut resources)?;
        }
        for output in &composition.outputs {
            let usage = TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC;
            let size = [view.resolution_px[0], view.resolution_px[1], 1];
            let texture =
                allocator.texture(output, size, wgpu::TextureFormat::Rgba32Float, usage)?;
            resources.texture(output, texture);
        }
        let bodies = &view.geometry.bodies;
        let maker = Maker::new(gpu, allocator, bodies, view.resolution_px)?;
        let maker = maker.within(composition.within_px);
        let front = composition.front.as_ref();
        let front = front.map(|front| maker.surfaces(front, &mut resources)).transpose()?;
        let back = composition.back.as_ref();
        let back = back.map(|back| maker.surfaces(back, &mut resources)).transpose()?;
        let peel = composition.peel.as_ref();
        let peel = peel.map(|peel| Peeled::new(&maker, peel, view, &mut resources)).transpose()?;
        let interior = composition
            .interior
            .as_ref()
            .map(|interior| DrawnInterior::new(&maker, interior, view, &mut resources));
        let interior = interior.transpose()?;
        let normals = composition
            .normals
            .as_ref()
            .map(|normals| DrawnNormals::new(&maker, normals, view, &mut resources));
        let normals = normals.transpose()?;
        let shade = maker.over_pixels(&composition.shade, "shade", &resources)?;
        let resolution_px = view.resolution_px;
        Ok(Self { resolution_px, backdrop, normals, front, back, peel, interior, shade, resources })
    }
}
