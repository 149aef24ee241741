// The mixture is made a unit vector that faces the eye.

fn finish_normal(mixed: vec3f, v_ws: vec3f) -> vec3f {
    return normalize(select(-mixed, mixed, dot(mixed, v_ws) < 0.0));
}
