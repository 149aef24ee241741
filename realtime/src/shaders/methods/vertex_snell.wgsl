// needs: frame index interface
// Snell's law at a vertex.

fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec4f {
    let eta = effective_index(bodies[body].eta);
    return vec4f(bend(v_ws, n_ws, frame.eta_outside / eta).direction, 1.0);
}
