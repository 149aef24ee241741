//! The wrapper around wgpu's encoder and allocator. It writes down what was
//! executed and allocated, by itself: the planner has no say here, so that a
//! plan and a run can disagree and a test can notice.

use crate::{Error, Gpu};

use scenes::plan::Buffer;
use std::cell::RefCell;

/// Makes memory and remembers how much.
pub(crate) struct Allocator<'g> {
    pub(crate) gpu: &'g Gpu,
    allocated: RefCell<Vec<Buffer>>,
}

impl<'g> Allocator<'g> {
    pub(crate) fn new(gpu: &'g Gpu) -> Self {
        Self { gpu, allocated: RefCell::new(Vec::new()) }
    }

    pub(crate) fn allocated(&self) -> Vec<Buffer> {
        self.allocated.borrow().clone()
    }

    fn note(&self, name: &str, bytes: u64) {
        self.allocated.borrow_mut().push(Buffer { name: name.to_owned(), bytes });
    }

    pub(crate) fn texture(
        &self,
        name: &str,
        size_px: [u32; 3],
        format: wgpu::TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> Result<wgpu::Texture, Error> {
        let limit = self.gpu.device.limits().max_texture_dimension_2d;
        let largest = size_px[0].max(size_px[1]);
        if largest > limit {
            return Err(Error::Limit {
                what: format!("texture {name}"),
                needed: u64::from(largest),
                adapter: self.gpu.info().name.clone(),
                allowed: u64::from(limit),
                advice: "lower the resolution or the number of positions per pixel".to_owned(),
            });
        }
        let texel = u64::from(format.block_copy_size(Some(wgpu::TextureAspect::All)).unwrap_or(4));
        self.note(name, size_px.iter().map(|n| u64::from(*n)).product::<u64>() * texel);
        Ok(self.gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(name),
            size: wgpu::Extent3d {
                width: size_px[0],
                height: size_px[1],
                depth_or_array_layers: size_px[2],
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        }))
    }

    pub(crate) fn buffer(
        &self,
        name: &str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, Error> {
        let limit = self.gpu.device.limits().max_buffer_size;
        if bytes > limit {
            return Err(Error::Limit {
                what: format!("buffer {name}"),
                needed: bytes,
                adapter: self.gpu.info().name.clone(),
                allowed: limit,
                advice: "use fewer triangles, layers or pixels".to_owned(),
            });
        }
        self.note(name, bytes);
        let descriptor = wgpu::BufferDescriptor {
            label: Some(name),
            size: bytes.next_multiple_of(4).max(16),
            usage,
            mapped_at_creation: false,
        };
        Ok(self.gpu.device.create_buffer(&descriptor))
    }

    pub(crate) fn filled(
        &self,
        name: &str,
        contents: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, Error> {
        let buffer =
            self.buffer(name, contents.len() as u64, usage | wgpu::BufferUsages::COPY_DST)?;
        let mut padded = contents.to_vec();
        padded.resize(contents.len().next_multiple_of(4), 0);
        self.gpu.queue.write_buffer(&buffer, 0, &padded);
        Ok(buffer)
    }
}

/// Records one frame.
pub(crate) struct Recorder<'g> {
    gpu: &'g Gpu,
    encoder: wgpu::CommandEncoder,
    queries: Option<wgpu::QuerySet>,
    executed: Vec<String>,
}

/// What one frame did and how long it took.
#[derive(Clone, Debug, Default)]
pub(crate) struct Executed {
    pub(crate) passes: Vec<String>,
    /// Milliseconds per pass, where the adapter has timestamps. Lavapipe writes
    /// those of some compute passes only at the end of the frame, so there they may
    /// be far too short.
    pub(crate) timestamp_ms: Option<Vec<f64>>,
    /// Milliseconds from submission to completion.
    pub(crate) wall_ms: f64,
}

const MAX_PASSES: u32 = 256;

impl<'g> Recorder<'g> {
    pub(crate) fn new(gpu: &'g Gpu, timed: bool) -> Self {
        let queries = (timed && gpu.timestamps).then(|| {
            gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("pass times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MAX_PASSES,
            })
        });
        let encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        Self { gpu, encoder, queries, executed: Vec::new() }
    }

    fn begin(&mut self, name: &str) -> u32 {
        self.executed.push(name.to_owned());
        2 * (self.executed.len() as u32 - 1)
    }

    pub(crate) fn raster(
        &mut self,
        name: &str,
        colours: &[(&wgpu::TextureView, Option<wgpu::Color>)],
        depth: Option<(&wgpu::TextureView, f32)>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let query = self.begin(name);
        let attachments: Vec<_> = colours
            .iter()
            .map(|(view, clear)| {
                Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: clear.map_or(wgpu::LoadOp::Load, wgpu::LoadOp::Clear),
                        store: wgpu::StoreOp::Store,
                    },
                })
            })
            .collect();
        let mut pass = self.encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(name),
            color_attachments: &attachments,
            depth_stencil_attachment: depth.map(|(view, clear)| {
                wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(clear),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }
            }),
            timestamp_writes: self.queries.as_ref().map(|query_set| {
                wgpu::RenderPassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: Some(query),
                    end_of_pass_write_index: Some(query + 1),
                }
            }),
            ..Default::default()
        });
        draw(&mut pass);
    }

    /// Fills a buffer with zeros.
    pub(crate) fn clear(&mut self, name: &str, buffer: &wgpu::Buffer) {
        self.begin(name);
        self.encoder.clear_buffer(buffer, 0, None);
    }

    pub(crate) fn compute(&mut self, name: &str, work: impl FnOnce(&mut wgpu::ComputePass<'_>)) {
        let query = self.begin(name);
        let mut pass = self.encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(name),
            timestamp_writes: self.queries.as_ref().map(|query_set| {
                wgpu::ComputePassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: Some(query),
                    end_of_pass_write_index: Some(query + 1),
                }
            }),
        });
        work(&mut pass);
    }

    /// Submits the frame and waits for it.
    pub(crate) fn finish(mut self) -> Result<Executed, Error> {
        let count = 2 * self.executed.len() as u32;
        let resolved = self.queries.as_ref().map(|queries| {
            let bytes = u64::from(count) * 8;
            let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
            let descriptor = wgpu::BufferDescriptor {
                label: None,
                size: bytes,
                usage,
                mapped_at_creation: false,
            };
            let buffer = self.gpu.device.create_buffer(&descriptor);
            self.encoder.resolve_query_set(queries, 0..count, &buffer, 0);
            buffer
        });
        let started = std::time::Instant::now();
        self.gpu.queue.submit([self.encoder.finish()]);
        self.gpu.wait()?;
        let wall_ms = started.elapsed().as_secs_f64() * 1e3;
        let period_ms = f64::from(self.gpu.queue.get_timestamp_period()) * 1e-6;
        let timestamp_ms = match resolved {
            None => None,
            Some(buffer) => {
                let bytes =
                    crate::gpu::readback::buffer_bytes(self.gpu, &buffer, u64::from(count) * 8)?;
                let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
                Some(
                    ticks
                        .chunks_exact(2)
                        .map(|t| t[1].saturating_sub(t[0]) as f64 * period_ms)
                        .collect(),
                )
            }
        };
        Ok(Executed { passes: self.executed, timestamp_ms, wall_ms })
    }
}
