// The factor that bends towards the normal. The twin of a_inverse.wgsl.

fn dx7_a(n: f32) -> f32 {
    return n;
}
