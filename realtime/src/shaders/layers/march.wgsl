// needs: frame peel_camera
// What the marches through layers share.

struct Chain {
    p_lc: vec3f,                // where it left
    d_ws: vec3f,                // unit direction in which it left
    hit2_lc: vec3f,             // where it met its second interface
    path_m: f32,                // metres inside a body
    events: u32,
    total_reflections: u32,
    steps: u32,
    flags: u32,
}

fn pixel_of(p_lc: vec3f) -> vec2i {
    return vec2i(floor(peel_px(p_lc)));
}

fn outside_bodies(p_lc: vec3f) -> bool {
    let from_middle = p_lc - frame.ball_lc;
    return dot(from_middle, from_middle) > 1.0002 * frame.radius_m * frame.radius_m;
}
