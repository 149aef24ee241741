// needs: frame
// Moves the far layers, which dual peeling kept in the last slots, next to the
// near ones.

@group(0) @binding(12) var<storage, read> slot_counts: array<u32>;
@group(0) @binding(13) var slot_depths: texture_storage_2d_array<r32uint, read_write>;
@group(0) @binding(14) var slot_normals: texture_storage_2d_array<r32uint, read_write>;

@compute @workgroup_size(8, 8)
fn close_layers(@builtin(global_invocation_id) id: vec3u) {
    let size = vec2u(frame.resolution_px);
    if (any(id.xy >= size)) {
        return;
    }
    let kept = min(slot_counts[id.y * size.x + id.x], frame.layer_capacity);
    if (kept == frame.layer_capacity) {
        return;
    }
    let far = kept / 2u;
    for (var i = 0u; i < far; i += 1u) {
        let from_slot = frame.layer_capacity - far + i;
        let to_slot = kept - far + i;
        textureStore(slot_depths, id.xy, to_slot, textureLoad(slot_depths, id.xy, from_slot));
        textureStore(slot_normals, id.xy, to_slot, textureLoad(slot_normals, id.xy, from_slot));
    }
}
