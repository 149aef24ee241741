//! What an adapter allows, asked before anything is allocated: by a plan and by a
//! rendering alike.

use crate::error::Error;
use crate::gpu::Gpu;

/// The limits of an adapter, and its name.
pub(crate) struct Limits<'g> {
    limits: wgpu::Limits,
    adapter: &'g str,
}

impl<'g> Limits<'g> {
    pub(crate) fn of(gpu: &'g Gpu) -> Self {
        Self { limits: gpu.device.limits(), adapter: &gpu.info().name }
    }

    /// An image fits into a texture.
    pub(crate) fn image(&self, what: &str, resolution_px: [u32; 2]) -> Result<(), Error> {
        let [width, height] = resolution_px;
        let what = format!("{what}, {width} x {height} pixels,");
        let allowed = u64::from(self.limits.max_texture_dimension_2d);
        self.fits(what, width.max(height).into(), allowed, "use fewer pixels along each side")
    }

    /// Images fit into the layers of one texture.
    pub(crate) fn array_layers(&self, what: &str, count: u32, advice: &str) -> Result<(), Error> {
        let allowed = u64::from(self.limits.max_texture_array_layers);
        self.fits(what.to_owned(), count.into(), allowed, advice)
    }

    /// A shader can be given a buffer as a whole.
    pub(crate) fn binding(&self, name: &str, bytes: u64, advice: &str) -> Result<(), Error> {
        let allowed = self.limits.max_storage_buffer_binding_size.min(self.limits.max_buffer_size);
        self.fits(format!("buffer {name}"), bytes, allowed, advice)
    }

    /// A buffer can be made.
    pub(crate) fn buffer(&self, name: &str, bytes: u64, advice: &str) -> Result<(), Error> {
        self.fits(format!("buffer {name}"), bytes, self.limits.max_buffer_size, advice)
    }

    fn fits(&self, what: String, needed: u64, allowed: u64, advice: &str) -> Result<(), Error> {
        if needed <= allowed {
            return Ok(());
        }
        let (adapter, advice) = (self.adapter.to_owned(), advice.to_owned());
        Err(Error::Limit { what, needed, adapter, allowed, advice })
    }
}
