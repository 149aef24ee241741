// needs: frame front eta fresnel
// The viewing direction of the pixel. The twin of eye_vertex.wgsl.

fn eye_vector(pixel: vec2i, v_ws: vec3f) -> vec3f {
    return v_ws;
}

fn share_at_surface(v_ws: vec3f, surface: Surface) -> f32 {
    return fresnel_share(v_ws, surface.normal_ws, frame.eta_outside, eta_body(surface.body));
}
