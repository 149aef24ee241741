// needs: interior_lookup
// Enclosed air covers what comes through the body. The twin of air_none.wgsl.

@group(0) @binding(21) var air: texture_2d<f32>;

fn with_air(pixel: vec2i, beyond: vec3f) -> vec3f {
    let white = of_inside(air, pixel);
    return beyond * (1.0 - white.a) + white.rgb;
}
