// needs: frame varyings surface_normal back_format
// What the back pass writes of the surface behind.

struct Targets {
    @location(0) back_normal: vec4f,
    @location(1) back_depth: f32,
}

fn targets(v: Varyings) -> Targets {
    return Targets(
        vec4f(stored_normal(surface_normal_ws(v)), v.body),
        depth_of_m(v.p_lc),
    );
}
