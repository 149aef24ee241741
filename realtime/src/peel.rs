//! Every interface of every pixel, sorted: memory for the depth complexity that
//! the view really has, counted once and not assumed.

use crate::composition::Peel;
use crate::frame::{self, Viewed};
use crate::pipelines::{DrawnSurfaces, Maker, OverPixels};
use crate::recorder::Recorder;
use crate::resources::Resources;
use crate::{Error, readback};
use wgpu::{BufferUsages, TextureUsages};

/// Most layers that are kept; what lies behind is flagged.
pub(crate) const MAX_LAYERS: u32 = 32;

/// The passes that fill the layers.
pub(crate) struct Peeled {
    collect: DrawnSurfaces,
    sort: OverPixels,
    /// Layers per pixel that are kept.
    pub(crate) capacity: u32,
}

impl Peeled {
    /// Counts the view's layers and makes room for them.
    pub(crate) fn new(
        maker: &Maker<'_>,
        peel: &Peel,
        view: &Viewed<'_>,
        resources: &mut Resources,
    ) -> Result<Self, Error> {
        let pixels = view.resolution_px.map(u64::from).iter().product::<u64>();
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let counts = maker.allocator.buffer("slot_counts", 4 * pixels, usage)?;
        resources.buffer("slot_counts", counts);
        let count = maker.surfaces(&peel.count, resources)?;
        let mut recorder = Recorder::new(maker.gpu, false);
        recorder.clear("clear layers", resources.stored("slot_counts"));
        count.record(&mut recorder, resources);
        recorder.finish()?;
        let bytes = readback::buffer_bytes(maker.gpu, resources.stored("slot_counts"), 4 * pixels)?;
        let most = bytemuck::pod_collect_to_vec::<u8, u32>(&bytes).into_iter().max().unwrap_or(0);
        let capacity = most.clamp(2, MAX_LAYERS);
        let size = [view.resolution_px[0], view.resolution_px[1], capacity];
        let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING;
        for name in ["slot_depths", "slot_normals"] {
            let format = wgpu::TextureFormat::R32Uint;
            let texture = maker.allocator.texture(name, size, format, usage)?;
            resources.texture_as(name, texture, wgpu::TextureViewDimension::D2Array);
        }
        frame::set_layer_capacity(maker.gpu, view, capacity, resources);
        let collect = maker.surfaces(&peel.collect, resources)?;
        let sort = maker.over_pixels(&peel.sort, "peel_sort", resources)?;
        Ok(Self { collect, sort, capacity })
    }

    pub(crate) fn record(
        &self,
        recorder: &mut Recorder<'_>,
        resources: &Resources,
        resolution_px: [u32; 2],
    ) {
        recorder.clear("clear layers", resources.stored("slot_counts"));
        self.collect.record(recorder, resources);
        self.sort.record(recorder, "sort layers", resolution_px);
    }
}
