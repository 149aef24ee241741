// The distance along the inward normal.

fn guessed_distance_m(w: f32, d_view_m: f32, d_normal_m: f32) -> f32 {
    return d_normal_m;
}
