// needs: sky
// The environment where the camera sees no opaque surface.

struct SkyTargets {
    @location(0) light: vec4f,
    @location(1) depth: f32,
}

@fragment
fn sky_fragment(@builtin(position) at: vec4f) -> SkyTargets {
    return SkyTargets(sky_light(at.xy), 1e30);
}
