// needs: frame varyings peel_packed
// One layer per pass: of what lies strictly behind the layers that are kept, the
// depth test leaves the nearest. Interfaces at the very same depth are one.
// Everitt, "Interactive order-independent transparency", NVIDIA, 2001.

@group(0) @binding(12) var<storage, read> slot_counts: array<u32>;
@group(0) @binding(13) var slot_depths: texture_2d_array<u32>;

// Depth and normal. Positive floats sort like their bits.
fn peeled_interface(v: Varyings) -> vec2u {
    let pixel = vec2u(v.clip.xy);
    let kept = slot_counts[pixel.y * u32(frame.resolution_px.x) + pixel.x];
    let depth = bitcast<u32>(depth_of_m(v.p_lc));
    if (kept > 0u && depth <= textureLoad(slot_depths, pixel, min(kept, frame.layer_capacity) - 1u, 0).x) {
        discard;
    }
    return vec2u(depth, packed_interface(v));
}

// Linear depth decides, to its last bit: the scale is a power of two.
struct Targets {
    @builtin(frag_depth) exact_depth: f32,
    @location(0) peeled: vec2u,
}

fn targets(v: Varyings) -> Targets {
    return Targets(depth_of_m(v.p_lc) * 0x1p-64f, peeled_interface(v));
}
