// needs: front
// Opaque surfaces around the bodies, drawn before. The twin of background_sky.wgsl.

@group(0) @binding(18) var background_light: texture_2d<f32>;   // w: 1 where a surface is
@group(0) @binding(19) var background_depth: texture_2d<f32>;

fn background(pixel: vec2i, v_ws: vec3f) -> vec4f {
    return textureLoad(background_light, pixel, 0);
}

// True if an opaque surface covers the body.
fn hidden(pixel: vec2i) -> bool {
    return textureLoad(background_depth, pixel, 0).x < textureLoad(front_depth, pixel, 0).x;
}
