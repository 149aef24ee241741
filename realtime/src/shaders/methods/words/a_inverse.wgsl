// The factor as printed: it bends away from the normal.

fn dx7_a(n: f32) -> f32 {
    return 1.0 / n;
}
