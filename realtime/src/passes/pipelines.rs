//! Pipelines made from shaders: raster passes over drawables and compute passes
//! over the pixels. Layouts come from the WGSL.

use super::raster_pass::{RasterPass, Sides};
use super::raster_state as state;
use crate::drawn::drawables::{Draw, Drawables, Formula};
use crate::drawn::uniforms::{self, Analytic};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::recorder::Recorder;
use crate::gpu::resources::Outputs;
use crate::wgsl::Shader;
use std::ops::Range;
use wgpu::TextureUsages;

/// What makes the pipelines of some drawables.
#[derive(Clone)]
pub(crate) struct Maker<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) allocator: &'a Allocator<'a>,
    drawables: &'a Drawables,
    corners: Option<wgpu::Buffer>,
    resolution_px: [u32; 2],
    /// Column, row, width and height of what is drawn; all if none is given.
    within_px: Option<[u32; 4]>,
}

type Bound = (wgpu::RenderPipeline, wgpu::BindGroup);

/// A raster pass, ready to be recorded.
pub(crate) struct ReadyRaster {
    name: &'static str,
    /// By location.
    targets: Vec<Option<wgpu::TextureView>>,
    depth: Option<(wgpu::TextureView, f32)>,
    behind: Option<Bound>,
    mesh: Option<(Bound, wgpu::Buffer)>,
    analytic: Vec<Bound>,
    triangles: Vec<Range<u32>>,
    within_px: Option<[u32; 4]>,
    keeps: bool,
}

/// A compute pass over all pixels.
pub(crate) struct OverPixels {
    pipeline: wgpu::ComputePipeline,
    bindings: wgpu::BindGroup,
}

impl OverPixels {
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, name: &str, resolution_px: [u32; 2]) {
        recorder.compute(name, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.bindings, &[]);
            let [width, height] = resolution_px.map(|n| n.div_ceil(8));
            pass.dispatch_workgroups(width, height, 1);
        });
    }
}

impl ReadyRaster {
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>) {
        // What is drawn onto another pass's image keeps that.
        let clear = (!self.keeps).then_some(wgpu::Color::TRANSPARENT);
        let colours: Vec<_> =
            self.targets.iter().map(|view| view.as_ref().map(|view| (view, clear))).collect();
        let depth = self.depth.as_ref().map(|(view, clear)| (view, *clear));
        recorder.raster(self.name, &colours, depth, |pass| {
            if let Some([x, y, width, height]) = self.within_px {
                pass.set_scissor_rect(x, y, width, height);
            }
            if let Some((pipeline, bindings)) = &self.behind {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, bindings, &[]);
                pass.draw(0..3, 0..1);
            }
            if let Some(((pipeline, bindings), corners)) = &self.mesh {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, bindings, &[]);
                pass.set_vertex_buffer(0, corners.slice(..));
                for range in &self.triangles {
                    pass.draw(range.clone(), 0..1);
                }
            }
            for (pipeline, bindings) in &self.analytic {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, bindings, &[]);
                pass.draw(0..3, 0..1);
            }
        });
    }

    /// The same under another name.
    pub(crate) fn named(mut self, name: &'static str) -> Self {
        self.name = name;
        self
    }
}

impl super::Record for ReadyRaster {
    fn record(&self, recorder: &mut Recorder<'_>, _: bool) {
        Self::record(self, recorder);
    }
}

impl<'a> Maker<'a> {
    pub(crate) fn new(
        gpu: &'a Gpu,
        allocator: &'a Allocator<'a>,
        drawables: &'a Drawables,
        resolution_px: [u32; 2],
    ) -> Result<Self, Error> {
        let corners = if drawables.corners.is_empty() {
            None
        } else {
            let bytes = bytemuck::cast_slice(&drawables.corners);
            Some(allocator.filled("corners", bytes, wgpu::BufferUsages::VERTEX)?)
        };
        Ok(Self { gpu, allocator, drawables, corners, resolution_px, within_px: None })
    }

    /// The same drawables at another resolution.
    pub(crate) fn resized(self, resolution_px: [u32; 2]) -> Self {
        Self { resolution_px, within_px: None, ..self }
    }

    /// Draws nothing outside a rectangle.
    pub(crate) fn within(self, within_px: Option<[u32; 4]>) -> Self {
        Self { within_px, ..self }
    }

    /// A compute pass whose entry point has the given name.
    pub(crate) fn over_pixels(
        &self,
        shader: &Shader,
        entry_point: &str,
        resources: &Outputs,
    ) -> Result<OverPixels, Error> {
        let pipeline = self.gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            module: &self.module(shader),
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let layout = pipeline.get_bind_group_layout(0);
        let bindings = resources.bind(self.gpu, shader, &[entry_point], &layout)?;
        Ok(OverPixels { pipeline, bindings })
    }

    /// A raster pass, and the images that it draws. One that is there already is
    /// drawn into, not made anew.
    pub(crate) fn raster(
        &self,
        raster: &RasterPass,
        before: &Outputs,
    ) -> Result<(ReadyRaster, Outputs), Error> {
        let outputs = self.images(raster, before)?;
        let mut targets = Vec::new();
        for target in &raster.targets {
            targets.resize(target.location as usize, None);
            let view = outputs.view(target.name).or_else(|| before.view(target.name));
            targets.push(view.cloned());
        }
        let mut ready = ReadyRaster {
            name: raster.name,
            targets,
            depth: self.depth_test(raster)?,
            behind: self.behind(raster, before)?,
            mesh: self.mesh(raster, before)?,
            analytic: Vec::new(),
            triangles: Vec::new(),
            within_px: self.within_px,
            keeps: raster.sides == Sides::Onto,
        };
        for draw in &self.drawables.draws {
            match draw {
                Draw::Triangles(range) => ready.triangles.push(range.clone()),
                Draw::Analytic(formula, placed, size_m, body) => {
                    let far_sides: &[bool] = match raster.sides {
                        Sides::Front => &[false],
                        Sides::Back { .. } => &[true],
                        _ => &[false, true],
                    };
                    for far in far_sides {
                        let centre = self.drawables.centre;
                        let uniform = Analytic::new(placed, centre, *size_m, *body, *far);
                        let drawn = self.analytic(raster, before, *formula, &uniform)?;
                        ready.analytic.extend(drawn);
                    }
                }
            }
        }
        Ok((ready, outputs))
    }

    fn images(&self, raster: &RasterPass, before: &Outputs) -> Result<Outputs, Error> {
        let size = [self.resolution_px[0], self.resolution_px[1], 1];
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC;
        let mut outputs = Outputs::default();
        for target in raster.targets.iter().filter(|target| before.view(target.name).is_none()) {
            let texture = self.allocator.texture(target.name, size, target.format, usage)?;
            outputs.texture(target.name, texture);
        }
        Ok(outputs)
    }

    fn depth_test(&self, raster: &RasterPass) -> Result<Option<(wgpu::TextureView, f32)>, Error> {
        let clear = match raster.sides {
            sides if !sides.has_depth() => return Ok(None),
            Sides::Back { farthest: true } | Sides::Outermost | Sides::Nearest => 1.0,
            _ => 0.0,
        };
        let size = [self.resolution_px[0], self.resolution_px[1], 1];
        let format = wgpu::TextureFormat::Depth32Float;
        let usage = TextureUsages::RENDER_ATTACHMENT;
        let depth = self.allocator.texture(&raster.depth_test(), size, format, usage)?;
        Ok(Some((depth.create_view(&wgpu::TextureViewDescriptor::default()), clear)))
    }

    fn behind(&self, raster: &RasterPass, before: &Outputs) -> Result<Option<Bound>, Error> {
        let Some(shader) = &raster.behind else { return Ok(None) };
        self.bound(raster, shader, ["sky_vertex", "sky_fragment"], before).map(Some)
    }

    fn mesh(
        &self,
        raster: &RasterPass,
        before: &Outputs,
    ) -> Result<Option<(Bound, wgpu::Buffer)>, Error> {
        let (Some(shader), Some(corners)) = (&raster.mesh, &self.corners) else {
            return Ok(None);
        };
        Ok(Some((self.bound(raster, shader, state::MESH, before)?, corners.clone())))
    }

    fn analytic(
        &self,
        raster: &RasterPass,
        before: &Outputs,
        formula: Formula,
        uniform: &Analytic,
    ) -> Result<Option<Bound>, Error> {
        let shader = raster.analytic.iter().find(|(known, _)| *known == formula);
        let Some((_, shader)) = shader else { return Ok(None) };
        let bytes = uniforms::bytes_of(uniform);
        let mut own = Outputs::default();
        let buffer = self.allocator.filled("analytic", &bytes, wgpu::BufferUsages::UNIFORM)?;
        own.buffer("analytic", buffer);
        let entries = ["analytic_vertex", "analytic_fragment"];
        self.bound(raster, shader, entries, &own.over(before)).map(Some)
    }

    fn bound(
        &self,
        raster: &RasterPass,
        shader: &Shader,
        entries: [&str; 2],
        resources: &Outputs,
    ) -> Result<Bound, Error> {
        let pipeline = state::pipeline(&self.gpu.device, raster, &self.module(shader), entries);
        let layout = pipeline.get_bind_group_layout(0);
        let bindings = resources.bind(self.gpu, shader, &entries, &layout)?;
        Ok((pipeline, bindings))
    }

    fn module(&self, shader: &Shader) -> wgpu::ShaderModule {
        self.gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(shader.text.as_str().into()),
        })
    }
}
