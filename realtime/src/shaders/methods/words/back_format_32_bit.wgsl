// A back normal as a texture of floats keeps it.

fn stored_normal(n_ws: vec3f) -> vec3f {
    return n_ws;
}
