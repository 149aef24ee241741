//! Pipelines made from shaders: raster passes over the bodies and compute passes
//! over the pixels. Layouts come from the WGSL.

use crate::drawn::drawables::{Draw, Formula, Parts};
use crate::drawn::uniforms::{self, Analytic};
use crate::gpu::recorder::{Allocator, Recorder};
use crate::gpu::resources::Resources;
use crate::passes::raster_pass::{Sides, Surfaces};
use crate::passes::raster_state as raster;
use crate::wgsl::Shader;
use crate::{Error, Gpu};

use std::ops::Range;
use wgpu::TextureUsages;

/// What every pass of a frame is made with.
#[derive(Clone)]
pub(crate) struct Maker<'a> {
    pub(crate) gpu: &'a Gpu,
    pub(crate) allocator: &'a Allocator<'a>,
    parts: &'a Parts,
    corners: Option<wgpu::Buffer>,
    resolution_px: [u32; 2],
    /// Column, row, width and height of what is drawn; all if none is given.
    within_px: Option<[u32; 4]>,
}

/// A raster pass over all bodies.
pub(crate) struct DrawnSurfaces {
    name: &'static str,
    targets: Vec<&'static str>,
    depth: Option<(wgpu::TextureView, f32)>,
    behind: Option<(wgpu::RenderPipeline, wgpu::BindGroup)>,
    mesh: Option<(wgpu::RenderPipeline, wgpu::BindGroup, wgpu::Buffer)>,
    analytic: Vec<(wgpu::RenderPipeline, wgpu::BindGroup)>,
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

impl DrawnSurfaces {
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>, resources: &Resources) {
        // What is drawn onto another pass's image keeps that.
        let clear = (!self.keeps).then_some(wgpu::Color::TRANSPARENT);
        let colours: Vec<_> =
            self.targets.iter().map(|name| (resources.view(name), clear)).collect();
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
            if let Some((pipeline, bindings, corners)) = &self.mesh {
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
}

impl DrawnSurfaces {
    /// The same under another name.
    pub(crate) fn named(mut self, name: &'static str) -> Self {
        self.name = name;
        self
    }
}

impl<'a> Maker<'a> {
    pub(crate) fn new(
        gpu: &'a Gpu,
        allocator: &'a Allocator<'a>,
        parts: &'a Parts,
        resolution_px: [u32; 2],
    ) -> Result<Self, Error> {
        let corners = if parts.corners.is_empty() {
            None
        } else {
            let bytes = bytemuck::cast_slice(&parts.corners);
            Some(allocator.filled("corners", bytes, wgpu::BufferUsages::VERTEX)?)
        };
        Ok(Self { gpu, allocator, parts, corners, resolution_px, within_px: None })
    }

    /// The same parts at another resolution.
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
        resources: &Resources,
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
        let bindings = resources.bind(self.gpu, shader, &[entry_point], &layout, &[])?;
        Ok(OverPixels { pipeline, bindings })
    }

    /// A raster pass with its targets.
    pub(crate) fn surfaces(
        &self,
        surfaces: &Surfaces,
        resources: &mut Resources,
    ) -> Result<DrawnSurfaces, Error> {
        let size = [self.resolution_px[0], self.resolution_px[1], 1];
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC;
        for target in &surfaces.targets {
            if resources.image(target.name).is_none() {
                let texture = self.allocator.texture(target.name, size, target.format, usage)?;
                resources.texture(target.name, texture);
            }
        }
        let mut drawn = DrawnSurfaces {
            name: surfaces.name,
            targets: surfaces.targets.iter().map(|target| target.name).collect(),
            depth: self.depth_test(surfaces, size)?,
            behind: self.behind(surfaces, resources)?,
            mesh: self.mesh(surfaces, resources)?,
            analytic: Vec::new(),
            triangles: Vec::new(),
            within_px: self.within_px,
            keeps: surfaces.sides == Sides::Onto,
        };
        for draw in &self.parts.draws {
            match draw {
                Draw::Triangles(range) => drawn.triangles.push(range.clone()),
                Draw::Analytic(formula, placed, size_m, body) => {
                    let far_sides: &[bool] = match surfaces.sides {
                        Sides::Front => &[false],
                        Sides::Back { .. } => &[true],
                        _ => &[false, true],
                    };
                    for far in far_sides {
                        let uniform =
                            Analytic::new(placed, self.parts.centre, *size_m, *body, *far);
                        drawn
                            .analytic
                            .extend(self.analytic(surfaces, resources, *formula, &uniform)?);
                    }
                }
            }
        }
        Ok(drawn)
    }

    fn depth_test(
        &self,
        surfaces: &Surfaces,
        size: [u32; 3],
    ) -> Result<Option<(wgpu::TextureView, f32)>, Error> {
        let clear = match surfaces.sides {
            sides if !sides.has_depth() => return Ok(None),
            Sides::Back { farthest: true } | Sides::Outermost => 0.0,
            _ => 1.0,
        };
        let name = format!("{} depth test", surfaces.name);
        let format = wgpu::TextureFormat::Depth32Float;
        let depth =
            self.allocator.texture(&name, size, format, TextureUsages::RENDER_ATTACHMENT)?;
        Ok(Some((depth.create_view(&wgpu::TextureViewDescriptor::default()), clear)))
    }

    fn behind(
        &self,
        surfaces: &Surfaces,
        resources: &Resources,
    ) -> Result<Option<(wgpu::RenderPipeline, wgpu::BindGroup)>, Error> {
        let Some(shader) = &surfaces.behind else { return Ok(None) };
        let entries = ["sky_vertex", "sky_fragment"];
        let pipeline = raster::pipeline(&self.gpu.device, surfaces, &self.module(shader), entries);
        let layout = pipeline.get_bind_group_layout(0);
        let bindings = resources.bind(self.gpu, shader, &entries, &layout, &[])?;
        Ok(Some((pipeline, bindings)))
    }

    fn mesh(
        &self,
        surfaces: &Surfaces,
        resources: &Resources,
    ) -> Result<Option<(wgpu::RenderPipeline, wgpu::BindGroup, wgpu::Buffer)>, Error> {
        let (Some(shader), Some(corners)) = (&surfaces.mesh, &self.corners) else {
            return Ok(None);
        };
        let entries = raster::MESH;
        let pipeline = raster::pipeline(&self.gpu.device, surfaces, &self.module(shader), entries);
        let layout = pipeline.get_bind_group_layout(0);
        let bindings = resources.bind(self.gpu, shader, &entries, &layout, &[])?;
        Ok(Some((pipeline, bindings, corners.clone())))
    }

    fn analytic(
        &self,
        surfaces: &Surfaces,
        resources: &Resources,
        formula: Formula,
        uniform: &Analytic,
    ) -> Result<Option<(wgpu::RenderPipeline, wgpu::BindGroup)>, Error> {
        let Some((_, shader)) = surfaces.analytic.iter().find(|(known, _)| *known == formula)
        else {
            return Ok(None);
        };
        let entries = ["analytic_vertex", "analytic_fragment"];
        let pipeline = raster::pipeline(&self.gpu.device, surfaces, &self.module(shader), entries);
        let bytes = uniforms::bytes_of(uniform);
        let buffer = self.allocator.filled("analytic", &bytes, wgpu::BufferUsages::UNIFORM)?;
        let layout = pipeline.get_bind_group_layout(0);
        let own = [("analytic", &buffer)];
        Ok(Some((pipeline, resources.bind(self.gpu, shader, &entries, &layout, &own)?)))
    }

    fn module(&self, shader: &Shader) -> wgpu::ShaderModule {
        self.gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(shader.text.as_str().into()),
        })
    }
}
