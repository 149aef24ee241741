// needs: frame
// Keeps the two layers whose normals peel_dual.wgsl has found: near ones from
// the first slot on, far ones from the last slot back. Then the depths that it
// found become the bounds of what is searched next.

@group(0) @binding(12) var<storage, read_write> slot_counts: array<u32>;
@group(0) @binding(13) var slot_depths: texture_storage_2d_array<r32uint, write>;
@group(0) @binding(14) var slot_normals: texture_storage_2d_array<r32uint, write>;
@group(0) @binding(25) var dual_extremes: texture_2d<f32>;
@group(0) @binding(26) var<storage, read_write> dual_bounds: array<vec2u>;
@group(0) @binding(27) var dual_normals: texture_2d<f32>;

const REVERSED: u32 = 0x7f000000u;
// Nothing lies between these.
const FINISHED: vec2u = vec2u(0xffffffffu, 0u);

fn keep(pixel: vec2u, slot: u32, depth: u32, halves: vec2f) {
    let packed = vec2u(halves - 1.0);
    textureStore(slot_depths, pixel, slot, vec4u(depth, 0u, 0u, 0u));
    textureStore(slot_normals, pixel, slot, vec4u(packed.x | (packed.y << 16u), 0u, 0u, 0u));
}

@compute @workgroup_size(8, 8)
fn keep_pair(@builtin(global_invocation_id) id: vec3u) {
    let size = vec2u(frame.resolution_px);
    if (any(id.xy >= size)) {
        return;
    }
    let place = id.y * size.x + id.x;
    let bounds = dual_bounds[place];
    if (all(bounds == FINISHED)) {
        return;
    }
    var kept = slot_counts[place];
    let near = kept / 2u;           // as many as far ones, until the last
    if (bounds.x != 0u) {
        let normals = textureLoad(dual_normals, id.xy, 0);
        if (kept < frame.layer_capacity) {
            keep(id.xy, near, bounds.x, normals.xy);
        }
        kept += 1u;
        if (bounds.x != bounds.y) {
            if (kept < frame.layer_capacity) {
                keep(id.xy, frame.layer_capacity - 1u - near, bounds.y, normals.zw);
            }
            kept += 1u;
        }
    }
    let next = textureLoad(dual_extremes, id.xy, 0);
    let found = next.y > 0.0;
    if (found && kept == frame.layer_capacity) {
        kept += 1u;                 // there is more than there is room for
    }
    slot_counts[place] = kept;
    dual_bounds[place] = select(FINISHED,
        vec2u(REVERSED - bitcast<u32>(next.x), bitcast<u32>(next.y)), found);
}
