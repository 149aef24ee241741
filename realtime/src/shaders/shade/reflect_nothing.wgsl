// needs: front
// The method refracts only.

fn reflected_share(v_ws: vec3f, surface: Surface) -> f32 {
    return 0.0;
}

fn reflected_light(v_ws: vec3f, surface: Surface, share: f32) -> vec3f {
    return vec3f(0.0);
}
