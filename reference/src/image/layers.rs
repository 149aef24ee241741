//! From pixels to the layers that are asked for.

use super::layer_table::{LayerRow, Needs, Pixel, Source, TABLE, Values, row_of};
use crate::error::Error;
use crate::request::Request;
use scenes::{LayerName, Layers, Scene};

/// Every layer that can be asked for, and what it shows.
pub const LAYERS: [(&str, &str); TABLE.len()] = {
    let mut list = [("", ""); TABLE.len()];
    let mut i = 0;
    while i < list.len() {
        list[i] = (TABLE[i].name, TABLE[i].shows);
        i += 1;
    }
    list
};

/// The layers asked for, in order, each once.
pub(crate) struct RequestedLayers {
    list: Vec<Requested>,
    /// Numbers per pixel.
    pub(crate) stride: usize,
    /// Numbers of interfaces whose light is kept apart.
    pub(crate) bounces: usize,
}

struct Requested {
    name: LayerName,
    row: &'static LayerRow,
    /// Of the medium, or of the bounce.
    number: usize,
}

impl RequestedLayers {
    /// # Errors
    /// A layer does not exist, or not with this scene and request.
    pub(crate) fn new(scene: &Scene, request: &Request) -> Result<Self, Error> {
        let mut list: Vec<Requested> = Vec::new();
        for name in &request.view.layers {
            let one = requested(scene, request, name)?;
            if !list.iter().any(|other| other.name == *name) {
                list.push(one);
            }
        }
        let order = |one: &Requested| match one.name {
            LayerName::Bounce(_) => one.number + 1,
            _ => 0,
        };
        Ok(Self {
            stride: list.iter().map(Requested::channels).sum(),
            bounces: list.iter().map(order).max().unwrap_or(0),
            list,
        })
    }

    fn needs(&self, source: Source) -> bool {
        self.list.iter().any(|one| one.row.source == source)
    }

    /// A layer shows the chain through the pixel's centre.
    pub(crate) fn needs_chain(&self) -> bool {
        self.needs(Source::Chain)
    }

    /// A layer shows the mean over the pixel's positions.
    pub(crate) fn needs_mean(&self) -> bool {
        self.needs(Source::Mean)
    }

    /// A layer shows where cracks are.
    pub(crate) fn needs_cracks(&self) -> bool {
        self.needs(Source::StraightLine)
    }

    /// A layer shows lengths per medium.
    pub(crate) fn needs_lengths(&self) -> bool {
        self.list.iter().any(|one| matches!(one.name, LayerName::Path(_)))
    }

    /// Names and channels, in order.
    pub(crate) fn names(&self) -> impl Iterator<Item = (&LayerName, usize)> {
        self.list.iter().map(|one| (&one.name, one.channels()))
    }

    /// Appends a pixel's numbers to a row of them.
    pub(crate) fn write(&self, pixel: &Pixel, numbers: &mut Vec<f64>) {
        for Requested { row, number, .. } in &self.list {
            match row.values {
                Values::One(value) => numbers.push(value(pixel, *number)),
                Values::Three(value) => numbers.extend(value(pixel, *number).to_array()),
            }
        }
    }

    /// Gathers finished rows into layers.
    pub(crate) fn gather(&self, resolution_px: [u32; 2], rows: &[Vec<f64>]) -> Layers {
        let mut layers = Layers::new(resolution_px);
        let mut offset = 0;
        for (name, channels) in self.names() {
            let pixels = rows.iter().flat_map(|row| row.chunks_exact(self.stride));
            let data = pixels.flat_map(|pixel| &pixel[offset..offset + channels]).copied();
            layers.push(name.clone(), channels, data.collect());
            offset += channels;
        }
        layers
    }
}

impl Requested {
    fn channels(&self) -> usize {
        self.row.values.channels()
    }
}

fn requested(scene: &Scene, request: &Request, name: &LayerName) -> Result<Requested, Error> {
    let unknown = || Error::Layer {
        layer: name.to_string(),
        available: LAYERS.map(|(name, _)| name).join(", "),
    };
    let row = row_of(name).ok_or_else(unknown)?;
    if !row.needs.are_met(request) {
        return Err(if row.needs == Needs::Batches { Error::NoVariance } else { unknown() });
    }
    let number = match name {
        LayerName::Path(wanted) => {
            let found = scene.media.iter().position(|medium| medium.name == *wanted);
            found.ok_or_else(unknown)?
        }
        LayerName::Bounce(order) => usize::from(*order),
        _ => 0,
    };
    Ok(Requested { name: name.clone(), row, number })
}
