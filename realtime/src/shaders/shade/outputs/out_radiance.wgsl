// Writes an image: radiance and coverage.

@group(0) @binding(32) var out_radiance: texture_storage_2d<rgba32float, write>;

fn put_radiance(pixel: vec2i, value: vec4f) {
    textureStore(out_radiance, pixel, value);
}
