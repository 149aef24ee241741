// needs: frame varyings opaque
// What stands around the bodies, as the camera sees it.

struct Targets {
    @location(0) background_light: vec4f,
    @location(1) background_depth: f32,
}

fn targets(v: Varyings) -> Targets {
    return Targets(
        opaque_light(v),
        depth_of_m(v.p_lc),
    );
}
