// a = 0: the back of the body plays no part and is not drawn.

fn blended_normal(pixel: vec2i, v_ws: vec3f, n_f: vec3f) -> vec3f {
    return n_f;
}

fn flag_back(pixel: vec2i, body: u32) -> u32 {
    return 0u;
}
