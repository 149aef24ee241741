// Writes an image: interfaces, flags and metres inside.

@group(0) @binding(36) var out_count: texture_storage_2d<rgba32float, write>;

fn put_count(pixel: vec2i, value: vec4f) {
    textureStore(out_count, pixel, value);
}
