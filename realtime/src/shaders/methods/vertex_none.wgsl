// Vertices have nothing to hand on to their pixels.

fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec4f {
    return vec4f(0.0);
}
