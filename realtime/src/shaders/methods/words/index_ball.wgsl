// The index that sends a paraxial ray through a ball the right way: n / (2 - n).

fn effective_index(eta: f32) -> f32 {
    return eta / max(2.0 - eta, 1e-3);
}
