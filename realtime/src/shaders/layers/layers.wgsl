// needs: frame pack peel_camera
// The sorted layers of a view: for each pixel depth and
// normal of every interface its ray meets, nearest first.
// Depth is linear, metres. Layers are counted from 0.

@group(0) @binding(12) var<storage, read> slot_counts: array<u32>;
@group(0) @binding(13) var slot_depths: texture_2d_array<u32>;
@group(0) @binding(14) var slot_normals: texture_2d_array<u32>;

const EMPTY_DEPTH: f32 = 1e30;

var<private> layers_overflowed: bool = false;

fn layer_count(pixel: vec2i) -> u32 {
    if (!in_layers(pixel)) {
        return 0u;
    }
    let place = u32(pixel.y) * u32(peel_size_px().x) + u32(pixel.x);
    let counted = slot_counts[place];
    layers_overflowed |= counted > peel_capacity();
    return min(counted, peel_capacity());
}

fn in_layers(pixel: vec2i) -> bool {
    return all(pixel >= vec2i(0)) && all(vec2f(pixel) < peel_size_px());
}

// Raised once a pixel was looked at that has more interfaces than are kept.
fn layer_flags() -> u32 {
    return select(0u, FLAG_OVERFLOW, layers_overflowed);
}

fn layer_depth_m(pixel: vec2i, layer: u32) -> f32 {
    return bitcast<f32>(textureLoad(slot_depths, pixel, layer, 0).x);
}

fn layer_packed(pixel: vec2i, layer: u32) -> u32 {
    return textureLoad(slot_normals, pixel, layer, 0).x;
}

fn layer_normal_ws(pixel: vec2i, layer: u32) -> vec3f {
    return unpack_normal(layer_packed(pixel, layer));
}

fn layer_faces_camera(pixel: vec2i, layer: u32) -> bool {
    return unpack_faces_camera(layer_packed(pixel, layer));
}

fn layer_solid(pixel: vec2i, layer: u32) -> u32 {
    return unpack_solid(layer_packed(pixel, layer));
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
