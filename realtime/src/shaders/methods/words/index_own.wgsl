// The medium's own index.

fn effective_index(eta: f32) -> f32 {
    return eta;
}
