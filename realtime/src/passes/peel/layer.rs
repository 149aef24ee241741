//! Reads layers back as images.

use crate::composition::layer_images::LayerImage;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::gpu::readback;
use crate::gpu::resources::Outputs;
use crate::plan::counted::Counted;

/// Reads one. `nested`: normals are packed with whose boundary it is.
pub(crate) fn read(
    image: LayerImage,
    gpu: &Gpu,
    outputs: &Outputs,
    counted: Counted,
    nested: bool,
) -> Result<Vec<f64>, Error> {
    let pixels = counted.pixels as usize;
    let bytes = readback::buffer_bytes(gpu, outputs.stored("slot_counts"), 4 * pixels as u64)?;
    let counts: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
    let held = counts.iter().map(|count| (*count).min(counted.capacity));
    let (name, layer) = match image {
        LayerImage::Count => return Ok(held.map(f64::from).collect()),
        LayerImage::Depth(layer) => ("slot_depths", layer),
        LayerImage::Normal(layer) | LayerImage::Facing(layer) => ("slot_normals", layer),
    };
    let mut texels = vec![0.0; pixels];
    if let Some(texture) = outputs.image(name).filter(|_| layer < counted.capacity) {
        let all = readback::texture_values(gpu, texture, 1)?;
        texels.copy_from_slice(&all[layer as usize * pixels..][..pixels]);
    }
    let bits = if nested { 13 } else { 15 };
    let channels = if matches!(image, LayerImage::Normal(_)) { 3 } else { 1 };
    let values = held.zip(texels).flat_map(|(held, texel)| {
        let packed = texel.to_bits();
        match image {
            _ if layer >= held => vec![0.0; channels],
            LayerImage::Normal(_) => normal_ws(packed, bits).to_vec(),
            LayerImage::Facing(_) => vec![f64::from(packed >> (2 * bits) & 1) * 2.0 - 1.0],
            _ => vec![f64::from(texel)],
        }
    });
    Ok(values.collect())
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
