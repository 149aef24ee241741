// needs: frame
// Appends the layer that peel_everitt.wgsl found to those of its pixel. Where
// there is no room left it is only counted.

@group(0) @binding(12) var<storage, read_write> slot_counts: array<u32>;
@group(0) @binding(13) var slot_depths: texture_storage_2d_array<r32uint, write>;
@group(0) @binding(14) var slot_normals: texture_storage_2d_array<r32uint, write>;
@group(0) @binding(25) var peeled: texture_2d<u32>;         // 0: nothing

@compute @workgroup_size(8, 8)
fn keep_layer(@builtin(global_invocation_id) id: vec3u) {
    let size = vec2u(frame.resolution_px);
    if (any(id.xy >= size)) {
        return;
    }
    let found = textureLoad(peeled, id.xy, 0);
    if (found.x == 0u) {
        return;
    }
    let place = id.y * size.x + id.x;
    let kept = slot_counts[place];
    if (kept < frame.layer_capacity) {
        textureStore(slot_depths, id.xy, kept, vec4u(found.x, 0u, 0u, 0u));
        textureStore(slot_normals, id.xy, kept, vec4u(found.y, 0u, 0u, 0u));
    }
    slot_counts[place] = min(kept, frame.layer_capacity) + 1u;
}
