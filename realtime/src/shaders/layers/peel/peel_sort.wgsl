// needs: frame
// Sorts the entries of each pixel by depth, then by packed normal, so that
// coincident walls come in the same order whatever order they were drawn in.
// Insertion sort: the lists are short and nearly sorted.

@group(0) @binding(12) var<storage, read> slot_counts: array<u32>;
@group(0) @binding(13) var slot_depths: texture_storage_2d_array<r32uint, read_write>;
@group(0) @binding(14) var slot_normals: texture_storage_2d_array<r32uint, read_write>;

@compute @workgroup_size(8, 8)
fn peel_sort(@builtin(global_invocation_id) id: vec3u) {
    let size = vec2u(frame.resolution_px);
    if (any(id.xy >= size)) {
        return;
    }
    let count = min(slot_counts[id.y * size.x + id.x], frame.layer_capacity);
    for (var i = 1u; i < count; i += 1u) {
        let depth = textureLoad(slot_depths, id.xy, i);
        let normal = textureLoad(slot_normals, id.xy, i);
        var j = i;
        while (j > 0u && comes_after(id.xy, j - 1u, depth.x, normal.x)) {
            textureStore(slot_depths, id.xy, j, textureLoad(slot_depths, id.xy, j - 1u));
            textureStore(slot_normals, id.xy, j, textureLoad(slot_normals, id.xy, j - 1u));
            j -= 1u;
        }
        textureStore(slot_depths, id.xy, j, depth);
        textureStore(slot_normals, id.xy, j, normal);
    }
}

// Positive floats sort like their bits.
fn comes_after(pixel: vec2u, slot: u32, depth: u32, normal: u32) -> bool {
    let other = textureLoad(slot_depths, pixel, slot).x;
    return other > depth || (other == depth && textureLoad(slot_normals, pixel, slot).x > normal);
}
