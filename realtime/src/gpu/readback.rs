//! From GPU memory to ours, piece by piece: an image of any size passes through
//! the same small memory.

use crate::error::Error;
use crate::gpu::Gpu;

use std::sync::mpsc;

/// Most bytes that are copied at once, unless a row of an image has more.
pub(crate) const PIECE_BYTES: u64 = 16 << 20;

/// Copies the first bytes of a buffer.
pub(crate) fn buffer_bytes(gpu: &Gpu, source: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>, Error> {
    let mut all = Vec::with_capacity(bytes as usize);
    buffer_pieces(gpu, source, bytes, |piece| all.extend_from_slice(piece))?;
    Ok(all)
}

/// Shows the first bytes of a buffer, a multiple of four at a time.
pub(crate) fn buffer_pieces(
    gpu: &Gpu,
    source: &wgpu::Buffer,
    bytes: u64,
    mut each: impl FnMut(&[u8]),
) -> Result<(), Error> {
    for start in (0..bytes).step_by(PIECE_BYTES as usize) {
        let size = PIECE_BYTES.min(bytes - start);
        let staging = staging(gpu, size);
        let mut encoder = encoder(gpu);
        encoder.copy_buffer_to_buffer(source, start, &staging, 0, Some(size));
        gpu.queue.submit([encoder.finish()]);
        read(gpu, &staging, &mut each)?;
    }
    Ok(())
}

/// Texels of a float texture, `channels` f32 per texel, rows from the top, one
/// layer after the other.
pub(crate) fn texture_values(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    channels: u32,
) -> Result<Vec<f32>, Error> {
    let size = [channels, texture.width(), texture.height(), texture.depth_or_array_layers()];
    let mut values = Vec::with_capacity(size.map(|n| n as usize).iter().product());
    texture_rows(gpu, texture, channels, |row| values.extend_from_slice(row))?;
    Ok(values)
}

/// The same, shown row by row.
pub(crate) fn texture_rows(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    channels: u32,
    mut each: impl FnMut(&[f32]),
) -> Result<(), Error> {
    let [width, height] = [texture.width(), texture.height()];
    let row_bytes = 4 * channels * width;
    let padded = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let at_once = (PIECE_BYTES / u64::from(padded)).clamp(1, height.into()) as u32;
    let mut values = vec![0.0_f32; channels as usize * width as usize];
    for layer in 0..texture.depth_or_array_layers() {
        for y in (0..height).step_by(at_once as usize) {
            let rows = at_once.min(height - y);
            let staging = copied(gpu, texture, [y, rows, layer], padded);
            read(gpu, &staging, |bytes| {
                for row in bytes.chunks_exact(padded as usize) {
                    bytemuck::cast_slice_mut(&mut values)
                        .copy_from_slice(&row[..row_bytes as usize]);
                    each(&values);
                }
            })?;
        }
    }
    Ok(())
}

/// A copy of some rows: the first, how many, and of which layer.
fn copied(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    [y, rows, layer]: [u32; 3],
    padded: u32,
) -> wgpu::Buffer {
    let staging = staging(gpu, u64::from(padded) * u64::from(rows));
    let mut encoder = encoder(gpu);
    let origin = wgpu::Origin3d { x: 0, y, z: layer };
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(padded),
        rows_per_image: Some(rows),
    };
    encoder.copy_texture_to_buffer(
        wgpu::TexelCopyTextureInfo { origin, ..texture.as_image_copy() },
        wgpu::TexelCopyBufferInfo { buffer: &staging, layout },
        wgpu::Extent3d { width: texture.width(), height: rows, depth_or_array_layers: 1 },
    );
    gpu.queue.submit([encoder.finish()]);
    staging
}

fn encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
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
