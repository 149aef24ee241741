// needs: frame
// Takes depths and normals of peel_cascade.wgsl apart. They are sorted already.

@group(0) @binding(12) var<storage, read> slot_counts: array<u32>;
@group(0) @binding(13) var slot_depths: texture_storage_2d_array<r32uint, write>;
@group(0) @binding(14) var slot_normals: texture_storage_2d_array<r32uint, write>;
@group(0) @binding(26) var<storage, read> cascade: array<vec2u>;     // x: low half

@compute @workgroup_size(8, 8)
fn unpack_layers(@builtin(global_invocation_id) id: vec3u) {
    let size = vec2u(frame.resolution_px);
    if (any(id.xy >= size)) {
        return;
    }
    let place = id.y * size.x + id.x;
    let count = min(slot_counts[place], frame.layer_capacity);
    for (var slot = 0u; slot < count; slot += 1u) {
        let key = ~cascade[place * frame.layer_capacity + slot];
        textureStore(slot_depths, id.xy, slot, vec4u(key.y, 0u, 0u, 0u));
        textureStore(slot_normals, id.xy, slot, vec4u(key.x, 0u, 0u, 0u));
    }
}
