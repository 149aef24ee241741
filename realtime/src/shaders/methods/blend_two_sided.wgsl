// Eq. 1 of Seipel & Nivfors: n_r = (1 - a) n_f - a n_b. The paper's n_b points
// outwards (away from the eye); BACK_SIGN = -1 takes the opposite reading.
// The twin of blend_one_sided.wgsl.

fn blended_normal(pixel: vec2i, v_ws: vec3f, n_f: vec3f) -> vec3f {
    let back = back_normal_at(pixel);
    if (back.w < 0.5) {
        return n_f;
    }
    let mixed = (1.0 - BLEND_A) * n_f - (BLEND_A * BACK_SIGN) * normalize(back.xyz);
    if (dot(mixed, mixed) < 1e-8) {
        return n_f;
    }
    return finish_normal(mixed, v_ws);
}

fn flag_back(pixel: vec2i, body: u32) -> u32 {
    return flag_other_body(pixel, body);
}
