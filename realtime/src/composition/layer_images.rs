//! Layers as images that can be asked for: `layer_count`, and `layer_depth.N`,
//! `layer_normal.N` and `layer_facing.N` with N from 0 for the nearest.

use crate::request::Request;
use scenes::LayerName;

/// Most layers that are kept; what lies behind is flagged.
pub(crate) const MAX_LAYERS: u32 = 32;

/// What of the layers an image shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LayerImage {
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

impl LayerImage {
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
}

/// True if some image of the layers was asked for.
pub(crate) fn asked_for(request: &Request) -> bool {
    request.view.layers.iter().any(|layer| match layer {
        LayerName::Buffer(name) => LayerImage::named(name).is_some(),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_one_spelling() {
        assert_eq!(LayerImage::named("layer_count"), Some(LayerImage::Count));
        assert_eq!(LayerImage::named("layer_depth.0"), Some(LayerImage::Depth(0)));
        assert_eq!(LayerImage::named("layer_normal.31"), Some(LayerImage::Normal(31)));
        for wrong in ["layer_depth", "layer_depth.", "layer_depth.01", "layer_depth.32", "layer.1"]
        {
            assert_eq!(LayerImage::named(wrong), None, "{wrong}");
        }
    }
}
