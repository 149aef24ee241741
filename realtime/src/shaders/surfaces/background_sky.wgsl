// needs: environment
// Nothing but the environment around the bodies.

fn background(pixel: vec2i, v_ws: vec3f) -> vec4f {
    return vec4f(environment(v_ws), 0.0);
}

fn hidden(pixel: vec2i) -> bool {
    return false;
}
