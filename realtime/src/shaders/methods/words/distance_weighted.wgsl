// Both distances, weighted by the angles.

fn guessed_distance_m(w: f32, d_view_m: f32, d_normal_m: f32) -> f32 {
    return w * d_view_m + (1.0 - w) * d_normal_m;
}
