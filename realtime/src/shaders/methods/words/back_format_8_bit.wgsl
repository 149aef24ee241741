// What an 8-bit texture keeps of (n + 1) / 2. The twin of back_format_32_bit.wgsl.

fn stored_normal(n_ws: vec3f) -> vec3f {
    return round((0.5 * n_ws + 0.5) * 255.0) / 127.5 - 1.0;
}
