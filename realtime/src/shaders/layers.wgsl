// The sorted layers of a view: for each pixel depth and
// normal of every interface its ray meets, nearest first.
// Depth is linear, metres. Layers are counted from 0.

@group(0) @binding(12) var<storage, read> slot_counts: array<u32>;
@group(0) @binding(13) var<storage, read> slot_depths: array<u32>;
@group(0) @binding(14) var<storage, read> slot_normals: array<u32>;

const EMPTY_DEPTH: f32 = 1e30;

fn slot_of(pixel: vec2i, layer: u32) -> u32 {
    let size = vec2u(frame.resolution_px);
    return (layer * size.y + u32(pixel.y)) * size.x + u32(pixel.x);
}

fn layer_count(pixel: vec2i) -> u32 {
    if (!in_image(pixel)) {
        return 0u;
    }
    return min(slot_counts[slot_of(pixel, 0u)], frame.layer_capacity);
}

fn layer_depth_m(pixel: vec2i, layer: u32) -> f32 {
    return bitcast<f32>(slot_depths[slot_of(pixel, layer)]);
}

fn layer_normal_ws(pixel: vec2i, layer: u32) -> vec3f {
    return unpack_normal(slot_normals[slot_of(pixel, layer)]);
}

fn layer_faces_camera(pixel: vec2i, layer: u32) -> bool {
    return unpack_faces_camera(slot_normals[slot_of(pixel, layer)]);
}

fn layer_solid(pixel: vec2i, layer: u32) -> u32 {
    return unpack_solid(slot_normals[slot_of(pixel, layer)]);
}

// How many interfaces stand in front of a depth in this pixel.
fn layers_before(pixel: vec2i, z_m: f32) -> u32 {
    let count = layer_count(pixel);
    var k = 0u;
    while (k < count && layer_depth_m(pixel, k) < z_m) {
        k += 1u;
    }
    return k;
}

// Depth between the interfaces around the k-th gap: between layer k-1 and k.
// Outside the stack there is no gap to divide and `open_m` is returned.
fn gap_m(pixel: vec2i, k: u32, open_m: f32) -> f32 {
    if (k == 0u || k >= layer_count(pixel)) {
        return open_m;
    }
    return layer_depth_m(pixel, k) - layer_depth_m(pixel, k - 1u);
}
