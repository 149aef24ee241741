// needs: frame varyings surface_normal
// The bodies' normals and how far they reach, seen from their middle.

struct Targets {
    @location(0) normal_face: vec4f,
}

fn targets(v: Varyings) -> Targets {
    return Targets(
        vec4f(surface_normal_ws(v), distance(v.p_lc, frame.middle_lc)),
    );
}
