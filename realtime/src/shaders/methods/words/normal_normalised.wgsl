// The mixture is made a unit vector.

fn finish_normal(mixed: vec3f, v_ws: vec3f) -> vec3f {
    return normalize(mixed);
}
