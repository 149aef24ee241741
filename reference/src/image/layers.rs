//! From pixels to named layers.

use crate::error::Error;
use crate::request::{Estimator, Level, Paths, Request};
use crate::transport::chain::Chain;
use glam::DVec3;
use scenes::{LayerName, Layers, Scene};

/// Layer: 1 where the straight ray through the pixel's centre meets a crack
/// inside its solid.
const CRACK_MASK: &str = "crack_mask";

/// Layer: Stokes parameters Q, U, V of the middle channel (the d line), for the
/// image's horizontal axis.
const STOKES: &str = "stokes";

/// Every layer that can be asked for, and what it shows.
pub const LAYERS: [(&str, &str); 16] = [
    ("radiance", "linear radiance, mean over the pixel"),
    ("variance", "variance of that mean; random paths in 2 batches or more"),
    ("samples", "camera rays per pixel"),
    ("truncated", "weight of the paths that were cut off, mean over the pixel"),
    ("coverage", "share of the pixel's positions whose ray meets an object"),
    ("bounce<N>", "radiance that arrives after exactly N interfaces, such as bounce2; not with R0"),
    ("stokes", "Stokes parameters Q, U, V of the d line; polarised, not with R0"),
    ("exit", "unit direction in which the chain through the pixel's centre leaves"),
    ("exit_position", "where the chain leaves, metres"),
    ("first", "unit direction after the chain's first event"),
    ("hit2", "where the chain meets its second interface, metres"),
    ("events", "interfaces that the chain meets"),
    ("total_reflections", "how many of them reflect it totally"),
    ("flags", "bits, told by `snell methods`"),
    ("path.<MEDIUM>", "metres that the chain travels in a medium, by its name in the scene"),
    ("crack_mask", "1 where the straight ray through the centre meets a crack in a solid"),
];

fn is_mask(name: &LayerName) -> bool {
    matches!(name, LayerName::Buffer(name) if name == CRACK_MASK)
}

/// Everything that can be known about a pixel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pixel {
    pub(crate) chain: Chain,
    pub(crate) radiance: DVec3,
    pub(crate) truncated: f64,
    pub(crate) coverage: f64,
    pub(crate) samples: f64,
    /// Of the mean over batches.
    pub(crate) variance: DVec3,
    /// Radiance by number of interfaces, as far as asked for.
    pub(crate) bounces: Vec<DVec3>,
    /// Q, U, V of the d line.
    pub(crate) polarisation: DVec3,
    /// The straight ray through the centre meets a crack inside a solid.
    pub(crate) crack: bool,
}

/// The layers asked for, as columns of a row of pixels.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    names: Vec<(LayerName, usize)>,
    /// Medium of each `path.<medium>` layer, in order.
    media: Vec<usize>,
    /// Numbers per pixel.
    pub(crate) stride: usize,
    /// A layer shows the chain through the pixel's centre.
    pub(crate) needs_chain: bool,
    /// A layer shows the mean over the pixel's positions.
    pub(crate) needs_mean: bool,
    /// A layer shows where cracks are.
    pub(crate) needs_cracks: bool,
    /// Numbers of interfaces whose light is kept apart.
    pub(crate) bounces: usize,
}

impl Columns {
    pub(crate) fn new(scene: &Scene, request: &Request) -> Result<Self, Error> {
        let mut names: Vec<(LayerName, usize)> = Vec::new();
        let (mut media, mut bounces) = (Vec::new(), 0);
        for name in &request.view.layers {
            let unknown = || Error::Layer {
                layer: name.to_string(),
                available: LAYERS.map(|(name, _)| name).join(", "),
            };
            let channels = match name {
                LayerName::Radiance
                | LayerName::Exit
                | LayerName::ExitPosition
                | LayerName::First
                | LayerName::Hit2 => 3,
                LayerName::Bounce(order) if request.level != Level::R0 && !request.polarised => {
                    bounces = bounces.max(usize::from(*order) + 1);
                    3
                }
                LayerName::Variance => match request.estimator {
                    Estimator::Paths(Paths { batches: 2.., .. }) if request.level != Level::R0 => 3,
                    _ => return Err(Error::NoVariance),
                },
                LayerName::Coverage
                | LayerName::Events
                | LayerName::TotalReflections
                | LayerName::Flags
                | LayerName::Truncated
                | LayerName::Samples => 1,
                LayerName::Path(medium) => {
                    let found = scene.media.iter().position(|m| m.name == *medium);
                    media.push(found.ok_or_else(unknown)?);
                    1
                }
                LayerName::Buffer(name) if name == CRACK_MASK => 1,
                LayerName::Buffer(name)
                    if name == STOKES && request.polarised && request.level != Level::R0 =>
                {
                    3
                }
                _ => return Err(unknown()),
            };
            if !names.iter().any(|(other, _)| other == name) {
                names.push((name.clone(), channels));
            }
        }
        Ok(Self {
            stride: names.iter().map(|(_, channels)| channels).sum(),
            needs_chain: names.iter().any(|(name, _)| is_of_chain(name)),
            needs_mean: names.iter().any(|(name, _)| !is_of_chain(name) && !is_mask(name)),
            needs_cracks: names.iter().any(|(name, _)| is_mask(name)),
            media,
            bounces,
            names,
        })
    }

    /// True if a layer shows lengths per medium.
    pub(crate) fn needs_lengths(&self) -> bool {
        !self.media.is_empty()
    }

    /// Names and channels, in order.
    pub(crate) fn names(&self) -> &[(LayerName, usize)] {
        &self.names
    }

    /// Appends a pixel's numbers to a row.
    pub(crate) fn write(&self, pixel: &Pixel, row: &mut Vec<f64>) {
        let chain = &pixel.chain;
        let mut media = self.media.iter();
        for (name, _) in &self.names {
            let vector = |row: &mut Vec<f64>, v: DVec3| row.extend(v.to_array());
            match name {
                LayerName::Radiance => vector(row, pixel.radiance),
                LayerName::Exit => vector(row, chain.exit),
                LayerName::ExitPosition => vector(row, chain.exit_position),
                LayerName::First => vector(row, chain.first),
                LayerName::Hit2 => vector(row, chain.hit2),
                LayerName::Coverage => row.push(pixel.coverage),
                LayerName::Events => row.push(f64::from(chain.events)),
                LayerName::TotalReflections => row.push(f64::from(chain.total_reflections)),
                LayerName::Flags => row.push(f64::from(chain.flags)),
                LayerName::Truncated => row.push(pixel.truncated),
                LayerName::Buffer(name) if name == STOKES => vector(row, pixel.polarisation),
                LayerName::Buffer(_) => row.push(f64::from(u8::from(pixel.crack))),
                LayerName::Samples => row.push(pixel.samples),
                LayerName::Variance => vector(row, pixel.variance),
                LayerName::Bounce(order) => {
                    let bounce = pixel.bounces.get(usize::from(*order));
                    vector(row, bounce.copied().unwrap_or_default());
                }
                _ => {
                    let length = media.next().and_then(|medium| chain.lengths.get(*medium));
                    row.push(length.copied().unwrap_or(0.0));
                }
            }
        }
    }

    /// Gathers finished rows into layers.
    pub(crate) fn layers(&self, resolution_px: [u32; 2], rows: &[Vec<f64>]) -> Layers {
        let mut layers = Layers::new(resolution_px);
        let mut offset = 0;
        for (name, channels) in &self.names {
            let pixels = rows.iter().flat_map(|row| row.chunks_exact(self.stride));
            let data = pixels.flat_map(|pixel| &pixel[offset..offset + channels]).copied();
            layers.push(name.clone(), *channels, data.collect());
            offset += channels;
        }
        layers
    }
}

/// True for layers that come from the chain through the pixel's centre.
fn is_of_chain(name: &LayerName) -> bool {
    matches!(
        name,
        LayerName::Exit
            | LayerName::ExitPosition
            | LayerName::First
            | LayerName::Hit2
            | LayerName::Events
            | LayerName::TotalReflections
            | LayerName::Flags
            | LayerName::Path(_)
    )
}
