// A depth interval of the inside's own: another size, or stored less precisely.
// The twin of interval_of_frame.wgsl.

@group(0) @binding(23) var clip_front: texture_2d<f32>;
@group(0) @binding(24) var clip_back: texture_2d<f32>;

fn interval_front_m(pixel: vec2i) -> f32 {
    return textureLoad(clip_front, pixel, 0).x;
}

fn interval_back_m(pixel: vec2i) -> f32 {
    return textureLoad(clip_back, pixel, 0).x;
}
