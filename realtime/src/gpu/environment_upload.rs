//! The environment's texels on the GPU: those of the scene's cube, nothing else.

use crate::gpu::recorder::Allocator;
use crate::gpu::resources::Resources;
use crate::wgsl::Shader;
use crate::{Error, Gpu};

use glam::DVec3;
use scenes::Environment;
use wgpu::TextureUsages;

/// Uploads what a shader reads: one number, the bordered faces, or a
/// cube for the hardware's sampler.
pub(crate) fn upload_environment(
    gpu: &Gpu,
    allocator: &Allocator<'_>,
    (shader, entry_point): (&Shader, &str),
    environment: &Environment,
    resources: &mut Resources,
) -> Result<(), Error> {
    let reads = |name| shader.uses(&[entry_point], name);
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
            let border = u32::from(reads("environment_faces"));
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
            resources.sampler("environment_linear", linear_sampler(gpu));
        }
    }
    Ok(())
}

pub(crate) fn linear_sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}

fn without_border(cube: &scenes::Cube) -> Vec<[f32; 4]> {
    let stride = cube.size_px as usize + 2;
    let inner = 1..=cube.size_px as usize;
    let rows = (0..6).flat_map(|face| inner.clone().map(move |y| (face * stride + y) * stride));
    rows.flat_map(|start| cube.texels[start + 1..start + stride - 1].iter().copied()).collect()
}
