// A depth as a number of 32 bits. The twin of depth_format_16_bit.wgsl.

fn stored_depth_m(z_m: f32) -> f32 {
    return z_m;
}

// Two steps of the number.
fn depth_error_m(z_m: f32) -> f32 {
    return 2.4e-7 * abs(z_m);
}
