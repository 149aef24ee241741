//! Every interface of every pixel, sorted: memory for the depth complexity that
//! the view really has, counted once and not assumed.

mod camera;
mod composed;
mod layer;
mod strategy;

pub(crate) use layer::read;

use super::pipelines::{OverPixels, ReadyRaster};
use super::{Composed, Listed, Maker, Making, Pass, Ready, Record, Wanted};
use crate::composition::inputs::Inputs;
use crate::composition::layer_images;
use crate::drawn::frame_uniforms::{self, Viewed};
use crate::drawn::uniforms;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::limits::Limits;
use crate::gpu::readback;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::methods::Settings;
use crate::plan::counted::Counted;
use crate::plan::entries::Entries;
use composed::{CLEAR, CLEAR_OWN, FRAME_OF_LAYERS, LAYERS, Peel, Step};
use glam::DVec2;
use scenes::plan::{Kind, Unsupported};
use strategy::Strategy;
use wgpu::{BufferUsages, TextureFormat, TextureUsages, TextureViewDimension};

pub(crate) const LISTED: Listed = Listed { compose, absent };

/// How many interfaces each pixel has: what others look at layers by.
const COUNTS: &str = "slot_counts";

fn compose(inputs: &Inputs<'_>, wanted: &Wanted<'_>) -> Composed {
    if !wanted.reads(COUNTS) && !layer_images::asked_for(inputs.request) {
        return Ok(None);
    }
    Ok(Some(Box::new(Peel::new(inputs)?)))
}

fn absent(entries: &mut Entries<'_>) {
    let reason = "the method does not look between the first and the last surface";
    entries.plan.leave_out(Kind::Pass, "layers", reason, 8 * entries.pixels * 2);
    if entries.geometry.media.len() > 1 {
        entries.plan.unsupported.push(Unsupported {
            what: "several bodies".to_owned(),
            instead: "light bends at the nearest body and does not meet another".to_owned(),
        });
    }
}

impl Pass for Peel {
    fn reads(&self, _: &str) -> bool {
        false
    }

    fn plan(&self, entries: &mut Entries<'_>) {
        self.plan_passes(entries);
        self.plan_buffers(entries);
    }

    fn check(&self, gpu: &Gpu, counted: Option<Counted>) -> Result<(), Error> {
        self.strategy.check(gpu)?;
        let limits = Limits::of(gpu);
        limits.image("the layers", self.resolution_px)?;
        let pixels: u64 = self.resolution_px.map(u64::from).iter().product();
        limits.binding(COUNTS, 4 * pixels, "use fewer pixels")?;
        let Some(counted) = counted else { return Ok(()) };
        limits.array_layers("the layers", counted.capacity, "lower max_layers")?;
        if let Some((name, bytes)) = self.strategy.own_buffer(counted.capacity) {
            let advice = "write peel = slots, lower max_layers, or use fewer pixels";
            limits.binding(name, bytes * pixels, advice)?;
        }
        Ok(())
    }

    fn count(&self, making: &Making<'_>) -> Result<Option<Counted>, Error> {
        let camera = self.camera.unwrap_or(*making.view.camera);
        let view = &Viewed { camera: &camera, resolution_px: self.resolution_px, ..*making.view };
        let (maker, own) = own(self, making, view)?;
        let resources = own.over(making.before);
        Ok(Some(count(&maker, self, view, making.shifts, &resources)?.1))
    }

    /// Counts the view's layers and makes room for them.
    fn ready(&self, making: &Making<'_>) -> Result<Ready, Error> {
        let camera = self.camera.unwrap_or(*making.view.camera);
        let view = &Viewed { camera: &camera, resolution_px: self.resolution_px, ..*making.view };
        let (maker, own) = own(self, making, view)?;
        let resources = own.clone().over(making.before);
        let (counts, counted) = count(&maker, self, view, making.shifts, &resources)?;
        self.check(maker.gpu, Some(counted))?;
        let resources = counts.clone().over(&own).over(making.before);
        let (room, cleared) = make_room(&maker, self, view, counted.capacity)?;
        let resources = room.clone().over(&resources);
        frame_uniforms::write(maker.gpu, resources.stored("frame"), view, counted.capacity);
        let (collect, found) = maker.raster(&self.collect, &resources)?;
        let resources = found.over(&resources);
        let step = |step: &Option<Step>| {
            let made = step.as_ref().map(|step| {
                let work = maker.over_pixels(&step.shader, step.entry_point, &resources)?;
                Ok::<_, Error>((step.pass, work))
            });
            made.transpose()
        };
        let ready = ReadyPeel {
            collect,
            draws: self.strategy.draws(counted),
            keep: step(&self.keep)?,
            finish: step(&self.finish)?,
            counts: resources.stored(COUNTS).clone(),
            own: cleared.map(|name| resources.stored(name).clone()),
            resolution_px: self.resolution_px,
        };
        let handed_on = [COUNTS, LAYERS[0], LAYERS[1], "peel_frame"];
        let outputs = room.over(&counts).over(&own).only(&handed_on);
        Ok(Ready { counted: Some(counted), ..Ready::new(ready, outputs) })
    }
}

/// The passes that fill the layers.
struct ReadyPeel {
    collect: ReadyRaster,
    draws: u32,
    keep: Option<(&'static str, OverPixels)>,
    finish: Option<(&'static str, OverPixels)>,
    counts: wgpu::Buffer,
    own: Option<wgpu::Buffer>,
    resolution_px: [u32; 2],
}

impl Record for ReadyPeel {
    fn record(&self, recorder: &mut Recorder<'_>, _: bool) {
        recorder.clear(CLEAR, &self.counts);
        if let Some(own) = &self.own {
            recorder.clear(CLEAR_OWN, own);
        }
        for _ in 0..self.draws {
            self.collect.record(recorder);
            if let Some((pass, keep)) = &self.keep {
                keep.record(recorder, pass, self.resolution_px);
            }
        }
        if let Some((pass, finish)) = &self.finish {
            finish.record(recorder, pass, self.resolution_px);
        }
    }
}

/// What draws the layers, and the camera's numbers: the image's, or their own.
fn own<'a>(
    peel: &Peel,
    making: &Making<'a>,
    view: &Viewed<'_>,
) -> Result<(Maker<'a>, Outputs), Error> {
    let (bodies, mut outputs) = (making.bodies.clone(), Outputs::default());
    if peel.camera.is_none() {
        return Ok((bodies, outputs));
    }
    let bytes = uniforms::bytes_of(&frame_uniforms::numbers(view, 0));
    let usage = BufferUsages::UNIFORM | BufferUsages::STORAGE;
    let buffer = bodies.allocator.filled(FRAME_OF_LAYERS, &bytes, usage)?;
    outputs.buffer("peel_frame", buffer.clone());
    outputs.buffer("frame", buffer);
    Ok((bodies.resized(peel.resolution_px), outputs))
}

/// Chooses the strategy that was left to the adapter.
pub(crate) fn decide(settings: &mut Settings, gpu: &Gpu) {
    if settings.word_if_any("peel") == Some("auto") {
        settings.decide("peel", Strategy::automatic(gpu.device.features()).word());
    }
}

fn pixels(view: &Viewed<'_>) -> u64 {
    view.resolution_px.map(u64::from).iter().product()
}

/// Interfaces of the pixel that has the most at any shift, and what counts them.
fn count(
    maker: &Maker<'_>,
    peel: &Peel,
    view: &Viewed<'_>,
    shifts: &[DVec2],
    before: &Outputs,
) -> Result<(Outputs, Counted), Error> {
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
    let bytes = 4 * pixels(view);
    let counts = maker.allocator.buffer(COUNTS, bytes, usage)?;
    let mut outputs = Outputs::default();
    outputs.buffer(COUNTS, counts.clone());
    let (count, images) = maker.raster(&peel.count, &outputs.clone().over(before))?;
    let mut most = 0;
    // Layers of a camera of their own are the same for every position.
    let shifts = if peel.camera.is_some() { &[DVec2::ZERO] } else { shifts };
    for shift in shifts {
        let shifted = Viewed { shift: *shift, ..*view };
        frame_uniforms::write(maker.gpu, before.stored("frame"), &shifted, 0);
        let mut recorder = Recorder::new(maker.gpu, false);
        recorder.clear(CLEAR, &counts);
        count.record(&mut recorder);
        recorder.finish()?;
        readback::buffer_pieces(maker.gpu, &counts, bytes, |piece| {
            let counts = bytemuck::pod_collect_to_vec::<u8, u32>(piece);
            most = counts.into_iter().fold(most, u32::max);
        })?;
    }
    Ok((outputs.over(&images), Counted::new(most, peel.max_layers, pixels(view))))
}

/// Memory for the layers, and for what only one strategy has, by its name.
fn make_room(
    maker: &Maker<'_>,
    peel: &Peel,
    view: &Viewed<'_>,
    capacity: u32,
) -> Result<(Outputs, Option<&'static str>), Error> {
    let mut outputs = Outputs::default();
    let size = [view.resolution_px[0], view.resolution_px[1], capacity];
    let usage =
        TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
    for name in LAYERS {
        let texture = maker.allocator.texture(name, size, TextureFormat::R32Uint, usage)?;
        outputs.texture_as(name, texture, TextureViewDimension::D2Array);
    }
    let Some((name, bytes_per_pixel)) = peel.strategy.own_buffer(capacity) else {
        return Ok((outputs, None));
    };
    let needed = bytes_per_pixel * pixels(view);
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
    outputs.buffer(name, maker.allocator.buffer(name, needed, usage)?);
    Ok((outputs, Some(name)))
}
