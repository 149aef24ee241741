// The mixture is left as it is.

fn finish_normal(mixed: vec3f, v_ws: vec3f) -> vec3f {
    return mixed;
}
