// The distance straight along the view.

fn guessed_distance_m(w: f32, d_view_m: f32, d_normal_m: f32) -> f32 {
    return d_view_m;
}
