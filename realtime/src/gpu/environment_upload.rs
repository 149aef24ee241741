//! The environment's texels on the GPU: those of the scene's cube, nothing else.

use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::allocator::Allocator;
use crate::gpu::resources::Outputs;
use crate::wgsl::Shader;

use glam::DVec3;
use scenes::{Cube, Environment};
use wgpu::{TextureFormat, TextureUsages, TextureViewDimension};

/// Uploads what a shader reads: one number, the bordered faces, or a
/// cube for the hardware's sampler.
pub(crate) fn upload_environment(
    gpu: &Gpu,
    allocator: &Allocator<'_>,
    (shader, entry_point): (&Shader, &str),
    environment: &Environment,
) -> Result<Outputs, Error> {
    let mut outputs = Outputs::default();
    match environment {
        Environment::Uniform(radiance) => {
            let DVec3 { x, y, z } = *radiance;
            let numbers = [x as f32, y as f32, z as f32, 1.0];
            let bytes: Vec<u8> = numbers.into_iter().flat_map(f32::to_le_bytes).collect();
            let uniform = wgpu::BufferUsages::UNIFORM;
            let buffer = allocator.filled("uniform_radiance", &bytes, uniform)?;
            outputs.buffer("uniform_radiance", buffer);
        }
        Environment::Map(map) => {
            let bordered = shader.uses(&[entry_point], "environment_faces");
            let (name, dimension) = if bordered {
                ("environment_faces", TextureViewDimension::D2Array)
            } else {
                ("environment_cube", TextureViewDimension::Cube)
            };
            outputs.texture_as(name, upload(gpu, allocator, name, &map.cube, bordered)?, dimension);
            outputs.sampler("environment_linear", linear_sampler(gpu));
        }
    }
    Ok(outputs)
}

/// The faces of a cube, with or without the texels of their neighbours.
fn upload(
    gpu: &Gpu,
    allocator: &Allocator<'_>,
    name: &str,
    cube: &Cube,
    bordered: bool,
) -> Result<wgpu::Texture, Error> {
    let edge = cube.size_px + 2 * u32::from(bordered);
    let (size, format) = ([edge, edge, 6], TextureFormat::Rgba32Float);
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let texture = allocator.texture(name, size, format, usage)?;
    let texels = if bordered { cube.texels.clone() } else { without_border(cube) };
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
    Ok(texture)
}

pub(crate) fn linear_sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}

fn without_border(cube: &Cube) -> Vec<[f32; 4]> {
    let stride = cube.size_px as usize + 2;
    let inner = 1..=cube.size_px as usize;
    let rows = (0..6).flat_map(|face| inner.clone().map(move |y| (face * stride + y) * stride));
    rows.flat_map(|start| cube.texels[start + 1..start + stride - 1].iter().copied()).collect()
}
