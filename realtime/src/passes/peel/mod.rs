//! Every interface of every pixel, sorted: memory for the depth complexity that
//! the view really has, counted once and not assumed.

mod camera;
mod composed;
mod layer;
mod strategy;

pub(crate) use camera::pieces as camera_pieces;
pub(crate) use composed::Peel;
pub(crate) use layer::{Part as LayerPart, asked_for};
pub(crate) use strategy::Counted;

use crate::drawn::frame_uniforms::{self, Viewed};
use crate::drawn::uniforms;
use crate::gpu::readback;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Resources;
use crate::methods::Settings;
use crate::passes::pipelines::{DrawnSurfaces, Maker, OverPixels};
use crate::{Error, Gpu};
use composed::{CLEAR_OWN, FRAME_OF_LAYERS, Step};
use strategy::Way;
use wgpu::{BufferUsages, TextureUsages};

/// The passes that fill the layers.
pub(crate) struct Peeled {
    collect: DrawnSurfaces,
    draws: u32,
    keep: Option<(&'static str, OverPixels)>,
    finish: Option<(&'static str, OverPixels)>,
    own: Option<&'static str>,
    resources: Resources,
    resolution_px: [u32; 2],
    /// What was counted.
    pub(crate) counted: Counted,
}

impl Peeled {
    /// Counts the view's layers and makes room for them; `shown` gets what
    /// others read.
    pub(crate) fn new(
        bodies: &Maker<'_>,
        peel: &Peel,
        view: &Viewed<'_>,
        shown: &mut Resources,
    ) -> Result<Self, Error> {
        peel.way.check(bodies.gpu)?;
        let camera = peel.camera.unwrap_or(*view.camera);
        let view = &Viewed { camera: &camera, resolution_px: peel.resolution_px, ..*view };
        let (maker, mut resources) = own(bodies, peel, view, shown)?;
        let most = count(&maker, peel, view, &mut resources)?;
        let counted = Counted::new(most, peel.max_layers);
        let own = make_room(&maker, peel, view, counted.capacity, &mut resources)?;
        frame_uniforms::set_layer_capacity(maker.gpu, view, counted.capacity, &resources);
        let collect = maker.surfaces(&peel.collect, &mut resources)?;
        let step = |step: &Option<Step>| {
            let made = step.as_ref().map(|step| {
                let work = maker.over_pixels(&step.shader, step.entry_point, &resources)?;
                Ok((step.pass, work))
            });
            made.transpose()
        };
        let (keep, finish) = (step(&peel.keep)?, step(&peel.finish)?);
        for name in ["slot_counts", "slot_depths", "slot_normals"] {
            resources.share(shown, name);
        }
        let draws = peel.way.draws(counted);
        let resolution_px = peel.resolution_px;
        Ok(Self { collect, draws, keep, finish, own, resources, resolution_px, counted })
    }

    pub(crate) fn record(&self, recorder: &mut Recorder<'_>) {
        recorder.clear("clear layers", self.resources.stored("slot_counts"));
        if let Some(own) = self.own {
            recorder.clear(CLEAR_OWN, self.resources.stored(own));
        }
        for _ in 0..self.draws {
            self.collect.record(recorder, &self.resources);
            if let Some((pass, keep)) = &self.keep {
                keep.record(recorder, pass, self.resolution_px);
            }
        }
        if let Some((pass, finish)) = &self.finish {
            finish.record(recorder, pass, self.resolution_px);
        }
    }
}

/// What draws the layers and what it reads: the image's camera, or their own.
fn own<'a>(
    bodies: &Maker<'a>,
    peel: &Peel,
    view: &Viewed<'_>,
    shown: &mut Resources,
) -> Result<(Maker<'a>, Resources), Error> {
    let mut resources = Resources::default();
    for name in ["bodies", "bumps"] {
        shown.share(&mut resources, name);
    }
    if peel.camera.is_none() {
        shown.share(&mut resources, "frame");
        return Ok((bodies.clone(), resources));
    }
    let bytes = uniforms::bytes_of(&frame_uniforms::numbers(view, 0));
    let usage = BufferUsages::UNIFORM | BufferUsages::STORAGE;
    let buffer = bodies.allocator.filled(FRAME_OF_LAYERS, &bytes, usage)?;
    shown.buffer("peel_frame", buffer.clone());
    resources.buffer("frame", buffer);
    Ok((bodies.clone().resized(peel.resolution_px), resources))
}

/// Chooses the way of peeling that was left to the adapter.
pub(crate) fn decide(settings: &mut Settings, gpu: &Gpu) {
    if settings.word_if_any("peel") == Some("auto") {
        settings.decide("peel", Way::automatic(gpu.device.features()).word());
    }
}

fn pixels(view: &Viewed<'_>) -> u64 {
    view.resolution_px.map(u64::from).iter().product()
}

/// Interfaces of the pixel that has the most.
fn count(
    maker: &Maker<'_>,
    peel: &Peel,
    view: &Viewed<'_>,
    resources: &mut Resources,
) -> Result<u32, Error> {
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
    let bytes = 4 * pixels(view);
    resources.buffer("slot_counts", maker.allocator.buffer("slot_counts", bytes, usage)?);
    let count = maker.surfaces(&peel.count, resources)?;
    let mut recorder = Recorder::new(maker.gpu, false);
    recorder.clear("clear layers", resources.stored("slot_counts"));
    count.record(&mut recorder, resources);
    recorder.finish()?;
    let counts = readback::buffer_bytes(maker.gpu, resources.stored("slot_counts"), bytes)?;
    Ok(bytemuck::pod_collect_to_vec::<u8, u32>(&counts).into_iter().max().unwrap_or(0))
}

/// Memory for the layers, and for what only one way of peeling has.
fn make_room(
    maker: &Maker<'_>,
    peel: &Peel,
    view: &Viewed<'_>,
    capacity: u32,
    resources: &mut Resources,
) -> Result<Option<&'static str>, Error> {
    let size = [view.resolution_px[0], view.resolution_px[1], capacity];
    let usage =
        TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
    for name in ["slot_depths", "slot_normals"] {
        let format = wgpu::TextureFormat::R32Uint;
        let texture = maker.allocator.texture(name, size, format, usage)?;
        resources.texture_as(name, texture, wgpu::TextureViewDimension::D2Array);
    }
    let Some((name, bytes_per_pixel)) = peel.way.own_buffer(capacity) else { return Ok(None) };
    let needed = bytes_per_pixel * pixels(view);
    let allowed = maker.gpu.device.limits().max_storage_buffer_binding_size;
    if needed > allowed {
        return Err(Error::Limit {
            what: format!("buffer {name}"),
            needed,
            adapter: maker.gpu.info().name.clone(),
            allowed,
            advice: "write peel = slots, lower max_layers, or use fewer pixels".to_owned(),
        });
    }
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
    resources.buffer(name, maker.allocator.buffer(name, needed, usage)?);
    Ok(Some(name))
}
