// needs: varyings camera clip
// Cracks drawn over the body's back normals, as the method's authors tried it:
// refraction then breaks at the cracks too. Normals point away from the eye, as
// those of the back do.

fn crack_normal(v: Varyings) -> vec4f {
    if (!is_inside(v)) {
        discard;
    }
    let n_ws = normalize(v.normal_ws);
    return vec4f(select(n_ws, -n_ws, dot(n_ws, direction_to_ws(v.p_lc)) < 0.0), v.body);
}

struct Targets {
    @location(0) back_normal: vec4f,
}

fn targets(v: Varyings) -> Targets {
    return Targets(crack_normal(v));
}
