// Writes an image: where the ray meets the second interface.

@group(0) @binding(35) var out_hit2: texture_storage_2d<rgba32float, write>;

fn put_hit2(pixel: vec2i, value: vec4f) {
    textureStore(out_hit2, pixel, value);
}
