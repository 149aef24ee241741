// Sorts the entries of each pixel by depth, then by packed normal, so that
// coincident walls come in the same order whatever order they were drawn in.
// Insertion sort: the lists are short and nearly sorted.

@group(0) @binding(12) var<storage, read> slot_counts: array<u32>;
@group(0) @binding(13) var<storage, read_write> slot_depths: array<u32>;
@group(0) @binding(14) var<storage, read_write> slot_normals: array<u32>;

@compute @workgroup_size(8, 8)
fn peel_sort(@builtin(global_invocation_id) id: vec3u) {
    let size = vec2u(frame.resolution_px);
    if (any(id.xy >= size)) {
        return;
    }
    let pixel = id.y * size.x + id.x;
    let stride = size.x * size.y;
    let count = min(slot_counts[pixel], frame.layer_capacity);
    for (var i = 1u; i < count; i += 1u) {
        let depth = slot_depths[i * stride + pixel];
        let normal = slot_normals[i * stride + pixel];
        var j = i;
        while (j > 0u && comes_after((j - 1u) * stride + pixel, depth, normal)) {
            slot_depths[j * stride + pixel] = slot_depths[(j - 1u) * stride + pixel];
            slot_normals[j * stride + pixel] = slot_normals[(j - 1u) * stride + pixel];
            j -= 1u;
        }
        slot_depths[j * stride + pixel] = depth;
        slot_normals[j * stride + pixel] = normal;
    }
}

// Positive floats sort like their bits.
fn comes_after(slot: u32, depth: u32, normal: u32) -> bool {
    let other = slot_depths[slot];
    return other > depth || (other == depth && slot_normals[slot] > normal);
}
