// The surface behind: normals point outwards, away from the eye.

@group(0) @binding(7) var back_normal: texture_2d<f32>;       // xyz outward, w: 1 where written
@group(0) @binding(8) var back_depth: texture_2d<f32>;

fn back_normal_at(pixel: vec2i) -> vec4f {
    return textureLoad(back_normal, pixel, 0);
}

fn back_depth_at_m(pixel: vec2i) -> f32 {
    return textureLoad(back_depth, pixel, 0).x;
}
