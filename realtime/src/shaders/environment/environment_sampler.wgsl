// The cube through the hardware's sampler, as a product would do it.

@group(0) @binding(2) var environment_cube: texture_cube<f32>;
@group(0) @binding(3) var environment_linear: sampler;

fn environment(d_ws: vec3f) -> vec3f {
    return textureSampleLevel(environment_cube, environment_linear, d_ws, 0.0).rgb;
}
