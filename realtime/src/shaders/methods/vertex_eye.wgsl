// needs: frame fresnel
// The viewing direction at a vertex, and the share that is reflected there.

fn vertex_vector(v_ws: vec3f, n_ws: vec3f, body: u32) -> vec4f {
    return vec4f(v_ws, fresnel_share(v_ws, n_ws, frame.eta_outside, bodies[body].eta));
}
