// needs: back parameters back_normal normal
// Eq. 1 of Seipel & Nivfors: n_r = (1 - a) n_f - a n_b. The paper's n_b points
// outwards (away from the eye); BACK_SIGN takes the reading.
// The twin of a_zero.wgsl.

fn blended_normal(pixel: vec2i, v_ws: vec3f, n_f: vec3f) -> vec3f {
    let back = back_normal_at(pixel);
    if (back.w < 0.5) {
        return n_f;
    }
    let mixed = (1.0 - A) * n_f - (A * BACK_SIGN) * normalize(back.xyz);
    if (dot(mixed, mixed) < 1e-8) {
        return n_f;
    }
    return finish_normal(mixed, v_ws);
}

fn flag_back(pixel: vec2i, body: u32) -> u32 {
    return flag_other_body(pixel, body);
}
