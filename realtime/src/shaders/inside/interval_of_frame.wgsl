// The depth interval that the front and back passes leave. The twin of
// interval_of_clip.wgsl.

@group(0) @binding(5) var front_depth: texture_2d<f32>;
@group(0) @binding(8) var back_depth: texture_2d<f32>;

fn interval_front_m(pixel: vec2i) -> f32 {
    return textureLoad(front_depth, pixel, 0).x;
}

fn interval_back_m(pixel: vec2i) -> f32 {
    return textureLoad(back_depth, pixel, 0).x;
}
