//! From GPU memory to ours.

use crate::error::Error;
use crate::gpu::Gpu;

use std::sync::mpsc;

/// Copies the first bytes of a buffer.
pub(crate) fn buffer_bytes(gpu: &Gpu, source: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>, Error> {
    let staging = staging(gpu, bytes);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(source, 0, &staging, 0, Some(bytes));
    gpu.queue.submit([encoder.finish()]);
    read(gpu, &staging, <[u8]>::to_vec)
}

/// Texels of a float texture, `channels` f32 per texel, rows from the top, one
/// layer after the other.
pub(crate) fn texture_values(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    channels: u32,
) -> Result<Vec<f32>, Error> {
    let [width, height] = [texture.width(), texture.height()];
    let row_bytes = 4 * channels * width;
    let padded = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let layers = texture.depth_or_array_layers();
    let staging = staging(gpu, u64::from(padded) * u64::from(height) * u64::from(layers));
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(padded),
        rows_per_image: Some(height),
    };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &staging, layout },
        wgpu::Extent3d { width, height, depth_or_array_layers: layers },
    );
    gpu.queue.submit([encoder.finish()]);
    read(gpu, &staging, |bytes| {
        let row = channels as usize * width as usize;
        let mut values = vec![0.0_f32; row * height as usize * layers as usize];
        let rows = values.chunks_exact_mut(row);
        for (row, bytes) in rows.zip(bytes.chunks_exact(padded as usize)) {
            bytemuck::cast_slice_mut(row).copy_from_slice(&bytes[..row_bytes as usize]);
        }
        values
    })
}

fn staging(gpu: &Gpu, bytes: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: bytes.next_multiple_of(4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    })
}

fn read<T>(gpu: &Gpu, staging: &wgpu::Buffer, of: impl FnOnce(&[u8]) -> T) -> Result<T, Error> {
    let (sender, receiver) = mpsc::channel();
    staging.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver outlives the wait below.
        let _ = sender.send(result);
    });
    gpu.wait()?;
    // Another thread's wait may be the one that calls back.
    match receiver.recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(gpu.failed(&error)),
        Err(error) => return Err(gpu.failed(&error)),
    }
    let view = staging.get_mapped_range(..).map_err(|error| gpu.failed(&error))?;
    Ok(of(&view))
}
