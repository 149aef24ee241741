// The same light from everywhere: one number, no texture.
// The twin of environment_manual.wgsl and environment_sampler.wgsl.

@group(0) @binding(2) var<uniform> uniform_radiance: vec4f;

fn environment(d_ws: vec3f) -> vec3f {
    return uniform_radiance.rgb;
}
