// needs: frame index dx7_formula
// The vector of fake refraction at a vertex.

fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec4f {
    return vec4f(dx7_vector(v_ws, n_ws, effective_index(bodies[body].eta) / frame.eta_outside), 1.0);
}
