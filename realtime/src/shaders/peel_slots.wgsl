// Every interface of a pixel goes to the next free slot, in whatever order it is
// drawn; peel_sort.wgsl sorts them. Liu et al., "Single pass depth peeling via
// CUDA rasterizer", SIGGRAPH 2009 talks, with fragment atomics instead of CUDA.

@group(0) @binding(12) var<storage, read_write> slot_counts: array<atomic<u32>>;
@group(0) @binding(13) var<storage, read_write> slot_depths: array<u32>;
@group(0) @binding(14) var<storage, read_write> slot_normals: array<u32>;

fn store_interface(v: Varyings) -> vec4f {
    let size = vec2u(frame.resolution_px);
    let pixel = vec2u(v.clip.xy);
    let v_ws = view_direction_ws(v.clip.xy);
    let slot = atomicAdd(&slot_counts[pixel.y * size.x + pixel.x], 1u);
    if (slot < frame.layer_capacity) {
        let place = (slot * size.y + pixel.y) * size.x + pixel.x;
        let body = u32(v.body + 0.5) - 1u;
        slot_depths[place] = bitcast<u32>(depth_of_m(v.p_lc));
        slot_normals[place] = pack_interface(
            normalize(v.normal_ws), dot(v_ws, v.geometric_ws) < 0.0, bodies[body].solid);
    }
    return vec4f(0.0);
}
