// needs: frame
// The surface behind: normals point outwards, away from the eye.

@group(0) @binding(7) var back_normal: texture_2d<f32>;       // xyz outward, w: number of the body, 0 = none
@group(0) @binding(8) var back_depth: texture_2d<f32>;

fn back_normal_at(pixel: vec2i) -> vec4f {
    return textureLoad(back_normal, pixel, 0);
}

fn back_depth_at_m(pixel: vec2i) -> f32 {
    return textureLoad(back_depth, pixel, 0).x;
}

// The surface behind belongs to another body than the one in front: what a
// method of two surfaces says of this pixel is not meant.
fn flag_other_body(pixel: vec2i, body: u32) -> u32 {
    let number = u32(back_normal_at(pixel).w + 0.5);
    return select(0u, FLAG_UNSUPPORTED, number != 0u && number != body + 1u);
}
