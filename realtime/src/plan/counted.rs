//! How many layers a view has, which only the GPU can tell.

/// What was counted before the first frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Counted {
    /// Layers per pixel that are kept.
    pub(crate) capacity: u32,
    /// Some pixel has more.
    pub(crate) overflows: bool,
    /// Of the layers' images.
    pub(crate) pixels: u64,
}

impl Counted {
    /// Room for the pixel with the most interfaces, up to a limit.
    pub(crate) fn new(most: u32, max_layers: u32, pixels: u64) -> Self {
        Self { capacity: most.clamp(2, max_layers), overflows: most > max_layers, pixels }
    }
}

impl Counted {
    /// Of all layers: a depth and a normal of 32 bits each.
    pub(crate) fn bytes(self) -> u64 {
        8 * u64::from(self.capacity) * self.pixels
    }
}
