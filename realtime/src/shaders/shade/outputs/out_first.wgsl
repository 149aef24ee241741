// Writes an image: the direction after the first interface.

@group(0) @binding(34) var out_first: texture_storage_2d<rgba32float, write>;

fn put_first(pixel: vec2i, value: vec4f) {
    textureStore(out_first, pixel, value);
}
