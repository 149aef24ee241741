//! The wrapper around wgpu's memory. It writes down what was allocated, by itself.

use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::limits::Limits;
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
        Limits::of(self.gpu).image(&format!("texture {name}"), [size_px[0], size_px[1]])?;
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
        let advice = "use fewer triangles, layers or pixels";
        Limits::of(self.gpu).buffer(name, bytes, advice)?;
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
