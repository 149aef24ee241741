// needs: environment front eye
// A reflection from the first surface, weighted by share_at_surface().
// The twin of reflect_nothing.wgsl.

fn reflected_share(v_ws: vec3f, surface: Surface) -> f32 {
    return share_at_surface(v_ws, surface);
}

fn reflected_light(v_ws: vec3f, surface: Surface, share: f32) -> vec3f {
    return environment(reflect(v_ws, surface.normal_ws));
}
