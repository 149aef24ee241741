//! The frame, in the order in which it runs. Read this first: [`Frame::record`]
//! is everything that happens on the GPU.

use crate::composition::{Composition, Surfaces};
use crate::geometry::{Corner, Draw, Formula, Geometry};
use crate::recorder::{Allocator, Recorder};
use crate::resources::Resources;
use crate::uniforms::{self, Analytic, Bodies, MAX_BODIES};
use crate::{Error, Gpu};
use glam::DVec3;
use scenes::{Camera, Environment};
use std::mem::size_of;
use wgpu::TextureUsages;

/// What a frame shows.
#[derive(Clone, Copy)]
pub(crate) struct Viewed<'a> {
    pub(crate) geometry: &'a Geometry,
    pub(crate) environment: &'a Environment,
    pub(crate) camera: &'a Camera,
    pub(crate) eta_outside: f64,
    pub(crate) resolution_px: [u32; 2],
}

/// Pipelines and memory of a frame, ready to run any number of times.
pub(crate) struct Frame {
    resolution_px: [u32; 2],
    front: DrawnSurfaces,
    back: Option<DrawnSurfaces>,
    shade: wgpu::ComputePipeline,
    shade_bindings: wgpu::BindGroup,
    pub(crate) resources: Resources,
}

impl Frame {
    /// Everything that happens, in order.
    pub(crate) fn record(&self, recorder: &mut Recorder<'_>) {
        self.front.record(recorder, &self.resources);
        if let Some(back) = &self.back {
            back.record(recorder, &self.resources);
        }
        recorder.compute("shade", |pass| {
            pass.set_pipeline(&self.shade);
            pass.set_bind_group(0, &self.shade_bindings, &[]);
            let [width, height] = self.resolution_px.map(|n| n.div_ceil(8));
            pass.dispatch_workgroups(width, height, 1);
        });
    }

    /// Makes pipelines and memory.
    pub(crate) fn new(
        gpu: &Gpu,
        allocator: &Allocator<'_>,
        composition: &Composition,
        view: &Viewed<'_>,
    ) -> Result<Self, Error> {
        let Viewed { geometry, environment, camera, eta_outside, resolution_px } = *view;
        let mut resources = Resources::default();
        let frame = uniforms::Frame::new(
            camera,
            resolution_px,
            geometry.centre,
            geometry.radius_m,
            eta_outside,
        );
        let uniform = wgpu::BufferUsages::UNIFORM;
        resources.buffer("frame", allocator.filled("frame", &uniforms::bytes_of(&frame), uniform)?);
        let mut list = [uniforms::Body::default(); MAX_BODIES];
        list[..geometry.bodies.len()].copy_from_slice(&geometry.bodies);
        let bodies = uniforms::bytes_of(&Bodies { list });
        resources.buffer("bodies", allocator.filled("bodies", &bodies, uniform)?);
        upload_environment(gpu, allocator, composition, environment, &mut resources)?;
        for output in &composition.outputs {
            let usage = TextureUsages::STORAGE_BINDING | TextureUsages::COPY_SRC;
            let size = [resolution_px[0], resolution_px[1], 1];
            let texture =
                allocator.texture(output, size, wgpu::TextureFormat::Rgba32Float, usage)?;
            resources.texture(output, texture);
        }
        let corners = if geometry.corners.is_empty() {
            None
        } else {
            let bytes = bytemuck::cast_slice(&geometry.corners);
            Some(allocator.filled("corners", bytes, wgpu::BufferUsages::VERTEX)?)
        };
        let make = |surfaces: &Surfaces, resources: &mut Resources| {
            DrawnSurfaces::new(
                gpu,
                allocator,
                surfaces,
                geometry,
                corners.as_ref(),
                resources,
                resolution_px,
            )
        };
        let front = make(&composition.front, &mut resources)?;
        let back = composition.back.as_ref().map(|back| make(back, &mut resources)).transpose()?;
        let module = shader_module(gpu, &composition.shade.text);
        let shade = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("shade"),
            layout: None,
            module: &module,
            entry_point: Some("shade"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let layout = shade.get_bind_group_layout(0);
        let shade_bindings = resources.bind(gpu, &composition.shade, &["shade"], &layout, &[])?;
        Ok(Self { resolution_px, front, back, shade, shade_bindings, resources })
    }
}

fn shader_module(gpu: &Gpu, text: &str) -> wgpu::ShaderModule {
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(text.into()),
    })
}

/// A raster pass over all bodies.
struct DrawnSurfaces {
    name: &'static str,
    targets: Vec<&'static str>,
    depth: wgpu::TextureView,
    clear_depth: f32,
    mesh: Option<(wgpu::RenderPipeline, wgpu::BindGroup, wgpu::Buffer)>,
    analytic: Vec<(wgpu::RenderPipeline, wgpu::BindGroup)>,
    triangles: Vec<std::ops::Range<u32>>,
}

impl DrawnSurfaces {
    fn record(&self, recorder: &mut Recorder<'_>, resources: &Resources) {
        let colours: Vec<_> = self
            .targets
            .iter()
            .map(|name| (resources.view(name), wgpu::Color::TRANSPARENT))
            .collect();
        recorder.raster(self.name, &colours, Some((&self.depth, self.clear_depth)), |pass| {
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

    fn new(
        gpu: &Gpu,
        allocator: &Allocator<'_>,
        surfaces: &Surfaces,
        geometry: &Geometry,
        corners: Option<&wgpu::Buffer>,
        resources: &mut Resources,
        resolution_px: [u32; 2],
    ) -> Result<Self, Error> {
        let size = [resolution_px[0], resolution_px[1], 1];
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_SRC;
        for target in &surfaces.targets {
            let texture = allocator.texture(target.name, size, target.format, usage)?;
            resources.texture(target.name, texture);
        }
        let name = format!("{} depth test", surfaces.name);
        let depth = allocator.texture(
            &name,
            size,
            wgpu::TextureFormat::Depth32Float,
            TextureUsages::RENDER_ATTACHMENT,
        )?;
        let mesh = match (&surfaces.mesh, corners) {
            (Some(shader), Some(corners)) => {
                let pipeline = raster_pipeline(gpu, surfaces, &shader.text, "mesh");
                let layout = pipeline.get_bind_group_layout(0);
                let entries = ["mesh_vertex", "mesh_fragment"];
                let bindings = resources.bind(gpu, shader, &entries, &layout, &[])?;
                Some((pipeline, bindings, corners.clone()))
            }
            _ => None,
        };
        let mut drawn = Self {
            name: surfaces.name,
            targets: surfaces.targets.iter().map(|target| target.name).collect(),
            depth: depth.create_view(&wgpu::TextureViewDescriptor::default()),
            clear_depth: if surfaces.farthest { 0.0 } else { 1.0 },
            mesh,
            analytic: Vec::new(),
            triangles: Vec::new(),
        };
        for draw in &geometry.draws {
            match draw {
                Draw::Triangles(range) => drawn.triangles.push(range.clone()),
                Draw::Analytic(formula, placed, size_m, body) => {
                    let uniform =
                        Analytic::new(placed, geometry.centre, *size_m, *body, surfaces.back);
                    drawn.add_analytic(gpu, allocator, surfaces, resources, *formula, &uniform)?;
                }
            }
        }
        Ok(drawn)
    }

    fn add_analytic(
        &mut self,
        gpu: &Gpu,
        allocator: &Allocator<'_>,
        surfaces: &Surfaces,
        resources: &Resources,
        formula: Formula,
        uniform: &Analytic,
    ) -> Result<(), Error> {
        let Some((_, shader)) = surfaces.analytic.iter().find(|(known, _)| *known == formula)
        else {
            return Ok(());
        };
        let pipeline = raster_pipeline(gpu, surfaces, &shader.text, "analytic");
        let buffer = allocator.filled(
            "analytic",
            &uniforms::bytes_of(uniform),
            wgpu::BufferUsages::UNIFORM,
        )?;
        let layout = pipeline.get_bind_group_layout(0);
        let entries = ["analytic_vertex", "analytic_fragment"];
        let bindings = resources.bind(gpu, shader, &entries, &layout, &[("analytic", &buffer)])?;
        self.analytic.push((pipeline, bindings));
        Ok(())
    }
}

fn raster_pipeline(gpu: &Gpu, surfaces: &Surfaces, text: &str, kind: &str) -> wgpu::RenderPipeline {
    let module = shader_module(gpu, text);
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Float32, 4 => Float32];
    let buffers = [Some(wgpu::VertexBufferLayout {
        array_stride: size_of::<Corner>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    })];
    let targets: Vec<_> =
        surfaces.targets.iter().map(|target| Some(target.format.into())).collect();
    let meshes = kind == "mesh";
    let cull = if surfaces.back { wgpu::Face::Front } else { wgpu::Face::Back };
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(surfaces.name),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(if meshes { "mesh_vertex" } else { "analytic_vertex" }),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: if meshes { &buffers } else { &[] },
        },
        primitive: wgpu::PrimitiveState { cull_mode: meshes.then_some(cull), ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(if surfaces.farthest {
                wgpu::CompareFunction::Greater
            } else {
                wgpu::CompareFunction::Less
            }),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(if meshes { "mesh_fragment" } else { "analytic_fragment" }),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn upload_environment(
    gpu: &Gpu,
    allocator: &Allocator<'_>,
    composition: &Composition,
    environment: &Environment,
    resources: &mut Resources,
) -> Result<(), Error> {
    let shade = |name| composition.shade.uses(&["shade"], name);
    match environment {
        Environment::Uniform(radiance) => {
            let DVec3 { x, y, z } = *radiance;
            let bytes: Vec<u8> = [x as f32, y as f32, z as f32, 1.0]
                .into_iter()
                .flat_map(f32::to_le_bytes)
                .collect();
            let buffer =
                allocator.filled("uniform_radiance", &bytes, wgpu::BufferUsages::UNIFORM)?;
            resources.buffer("uniform_radiance", buffer);
        }
        Environment::Map(map) => {
            let border = u32::from(shade("environment_faces"));
            let name = if border == 1 { "environment_faces" } else { "environment_cube" };
            let edge = map.cube.size_px + 2 * border;
            let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
            let texture = allocator.texture(
                name,
                [edge, edge, 6],
                wgpu::TextureFormat::Rgba32Float,
                usage,
            )?;
            let texels =
                if border == 1 { map.cube.texels.clone() } else { without_border(&map.cube) };
            gpu.queue.write_texture(
                texture.as_image_copy(),
                bytemuck::cast_slice(&texels),
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(16 * edge),
                    rows_per_image: Some(edge),
                },
                wgpu::Extent3d { width: edge, height: edge, depth_or_array_layers: 6 },
            );
            let dimension = if border == 1 {
                wgpu::TextureViewDimension::D2Array
            } else {
                wgpu::TextureViewDimension::Cube
            };
            resources.texture_as(name, texture, dimension);
            let linear = wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            };
            resources.sampler("environment_linear", gpu.device.create_sampler(&linear));
        }
    }
    Ok(())
}

fn without_border(cube: &scenes::Cube) -> Vec<[f32; 4]> {
    let stride = cube.size_px as usize + 2;
    let inner = 1..=cube.size_px as usize;
    let rows = (0..6).flat_map(|face| inner.clone().map(move |y| (face * stride + y) * stride));
    rows.flat_map(|start| cube.texels[start + 1..start + stride - 1].iter().copied()).collect()
}
