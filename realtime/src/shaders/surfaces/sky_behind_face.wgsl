// needs: sky
// The environment where a face of the cube sees no opaque surface.

@fragment
fn sky_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return sky_light(at.xy);
}
