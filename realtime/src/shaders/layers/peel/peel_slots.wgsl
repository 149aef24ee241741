// needs: frame varyings peel_packed
// Every interface of a pixel goes to the next free slot, in whatever order it is
// drawn; peel_sort.wgsl sorts them. Liu et al., "Single pass depth peeling via
// CUDA rasterizer", SIGGRAPH 2009 talks, with fragment atomics instead of CUDA.

@group(0) @binding(12) var<storage, read_write> slot_counts: array<atomic<u32>>;
@group(0) @binding(13) var slot_depths: texture_storage_2d_array<r32uint, write>;
@group(0) @binding(14) var slot_normals: texture_storage_2d_array<r32uint, write>;

fn store_interface(v: Varyings) -> vec4f {
    let pixel = vec2u(v.clip.xy);
    let slot = atomicAdd(&slot_counts[pixel.y * u32(frame.resolution_px.x) + pixel.x], 1u);
    if (slot < frame.layer_capacity) {
        let packed = packed_interface(v);
        textureStore(slot_depths, pixel, slot, vec4u(bitcast<u32>(depth_of_m(v.p_lc)), 0u, 0u, 0u));
        textureStore(slot_normals, pixel, slot, vec4u(packed, 0u, 0u, 0u));
    }
    return vec4f(0.0);
}
