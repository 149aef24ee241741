//! Layers as images that can be asked for: `layer_count`, and `layer_depth.N`,
//! `layer_normal.N` and `layer_facing.N` with N from 0 for the nearest.

use super::strategy::{Counted, MAX_LAYERS};
use crate::gpu::readback;
use crate::gpu::resources::Resources;
use crate::request::Request;
use crate::{Error, Gpu};
use scenes::LayerName;

/// What of the layers an image shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// How many there are.
    Count,
    /// Linear depth, metres; 0 where there is no such layer.
    Depth(u32),
    /// Outward normal in world axes; 0 where there is no such layer.
    Normal(u32),
    /// 1 where the surface faces the eye, -1 where it faces away, 0 where there
    /// is no such layer.
    Facing(u32),
}

/// True if some image of the layers was asked for.
pub(crate) fn asked_for(request: &Request) -> bool {
    request.view.layers.iter().any(|layer| match layer {
        LayerName::Buffer(name) => Part::named(name).is_some(),
        _ => false,
    })
}

impl Part {
    /// What a name stands for, if it is one of these.
    pub(crate) fn named(name: &str) -> Option<Self> {
        if name == "layer_count" {
            return Some(Self::Count);
        }
        let (kind, number) = name.split_once('.')?;
        let layer =
            number.parse::<u32>().ok().filter(|n| *n < MAX_LAYERS && n.to_string() == number)?;
        match kind {
            "layer_depth" => Some(Self::Depth(layer)),
            "layer_normal" => Some(Self::Normal(layer)),
            "layer_facing" => Some(Self::Facing(layer)),
            _ => None,
        }
    }

    /// Reads it. `nested`: normals are packed with whose boundary it is.
    pub(crate) fn read(
        self,
        gpu: &Gpu,
        resources: &Resources,
        counted: Counted,
        (pixels, nested): (usize, bool),
    ) -> Result<Vec<f64>, Error> {
        let bytes =
            readback::buffer_bytes(gpu, resources.stored("slot_counts"), 4 * pixels as u64)?;
        let counts: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
        let held = counts.iter().map(|count| (*count).min(counted.capacity));
        let (name, layer) = match self {
            Self::Count => return Ok(held.map(f64::from).collect()),
            Self::Depth(layer) => ("slot_depths", layer),
            Self::Normal(layer) | Self::Facing(layer) => ("slot_normals", layer),
        };
        let mut texels = vec![0.0; pixels];
        if let Some(texture) = resources.image(name).filter(|_| layer < counted.capacity) {
            let all = readback::texture_values(gpu, texture, 1)?;
            texels.copy_from_slice(&all[layer as usize * pixels..][..pixels]);
        }
        let bits = if nested { 13 } else { 15 };
        let channels = if matches!(self, Self::Normal(_)) { 3 } else { 1 };
        let values = held.zip(texels).flat_map(|(held, texel)| {
            let packed = texel.to_bits();
            match self {
                _ if layer >= held => vec![0.0; channels],
                Self::Normal(_) => normal_ws(packed, bits).to_vec(),
                Self::Facing(_) => vec![f64::from(packed >> (2 * bits) & 1) * 2.0 - 1.0],
                _ => vec![f64::from(texel)],
            }
        });
        Ok(values.collect())
    }
}

/// The normal in a packed interface: an octahedral map of twice `bits` bits, as
/// in pack_single.wgsl and pack_nested.wgsl.
fn normal_ws(packed: u32, bits: u32) -> [f64; 3] {
    let half = f64::from(1_u32 << (bits - 1));
    let coordinate =
        |shift: u32| (f64::from(packed >> shift & ((1 << bits) - 1)) - half) / (half - 1.0);
    let [x, y] = [coordinate(0), coordinate(bits)];
    let z = 1.0 - x.abs() - y.abs();
    let turned = |a: f64, b: f64| (1.0 - b.abs()) * if a >= 0.0 { 1.0 } else { -1.0 };
    let [x, y] = if z >= 0.0 { [x, y] } else { [turned(x, y), turned(y, x)] };
    let length = (x * x + y * y + z * z).sqrt();
    [x / length, y / length, z / length]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failing test may panic")]
    use super::*;

    #[test]
    fn names_have_one_spelling() {
        assert_eq!(Part::named("layer_count"), Some(Part::Count));
        assert_eq!(Part::named("layer_depth.0"), Some(Part::Depth(0)));
        assert_eq!(Part::named("layer_normal.31"), Some(Part::Normal(31)));
        for wrong in ["layer_depth", "layer_depth.", "layer_depth.01", "layer_depth.32", "layer.1"]
        {
            assert_eq!(Part::named(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn axes_are_unpacked() {
        let pack = |x: i32, y: i32, bits: u32| {
            let half = 1_i32 << (bits - 1);
            let scale = half - 1;
            (x * scale + half) as u32 | ((y * scale + half) as u32) << bits
        };
        for bits in [13, 15] {
            assert_eq!(normal_ws(pack(1, 0, bits), bits), [1.0, 0.0, 0.0]);
            assert_eq!(normal_ws(pack(0, -1, bits), bits), [0.0, -1.0, 0.0]);
            assert_eq!(normal_ws(pack(0, 0, bits), bits), [0.0, 0.0, 1.0]);
            assert_eq!(normal_ws(pack(1, 1, bits), bits)[2], -1.0);
        }
    }
}
