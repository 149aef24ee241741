// needs: frame varyings peel_packed
// Every interface is inserted where it belongs while it is drawn: each slot keeps
// the nearer of what it has and what comes, and hands on the other. The same bits
// whatever the order; where there is no room the farthest fall out.
// Liu et al., "Single pass depth peeling via CUDA rasterizer", SIGGRAPH 2009
// talks, with depth and normal in one atomic of 64 bits.
// Keys are complements, so that cleared memory is farther than everything.

@group(0) @binding(12) var<storage, read_write> slot_counts: array<atomic<u32>>;
@group(0) @binding(26) var<storage, read_write> cascade: array<atomic<u64>>;

fn store_interface(v: Varyings) -> vec4f {
    let pixel = vec2u(v.clip.xy);
    let place = pixel.y * u32(frame.resolution_px.x) + pixel.x;
    atomicAdd(&slot_counts[place], 1u);
    var key = ~((u64(bitcast<u32>(depth_of_m(v.p_lc))) << 32u) | u64(packed_interface(v)));
    for (var slot = 0u; slot < frame.layer_capacity; slot += 1u) {
        let before = atomicMax(&cascade[place * frame.layer_capacity + slot], key);
        if (before == 0lu) {
            break;
        }
        key = min(before, key);
    }
    return vec4f(0.0);
}
