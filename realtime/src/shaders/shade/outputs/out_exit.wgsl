// Writes an image: the direction in which the ray leaves.

@group(0) @binding(33) var out_exit: texture_storage_2d<rgba32float, write>;

fn put_exit(pixel: vec2i, value: vec4f) {
    textureStore(out_exit, pixel, value);
}
