//! The wrapper around wgpu's encoder. It writes down what was executed, as the
//! allocator does what was allocated, by itself: the planner has no say here, so
//! that a plan and a run can disagree and a test can notice.

use crate::error::Error;
use crate::gpu::Gpu;

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

impl Executed {
    /// Adds what was done after it.
    pub(crate) fn then(&mut self, next: Self) {
        // Either all are timed or none is.
        let before = self.timestamp_ms.take().unwrap_or_default();
        let timestamps = next.timestamp_ms.into_iter();
        self.timestamp_ms = timestamps.map(|after| [before.clone(), after].concat()).next();
        self.passes.extend(next.passes);
        self.wall_ms += next.wall_ms;
    }
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
        colours: &[Option<(&wgpu::TextureView, Option<wgpu::Color>)>],
        depth: Option<(&wgpu::TextureView, f32)>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let query = self.begin(name);
        let attachments: Vec<_> = colours
            .iter()
            .map(|colour| colour.map(|(view, clear)| attached(view, clear)))
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

/// A colour that is cleared before a pass, or kept.
fn attached(
    view: &wgpu::TextureView,
    clear: Option<wgpu::Color>,
) -> wgpu::RenderPassColorAttachment<'_> {
    let load = clear.map_or(wgpu::LoadOp::Load, wgpu::LoadOp::Clear);
    let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
    wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops }
}
