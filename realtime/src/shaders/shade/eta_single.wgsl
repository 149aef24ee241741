// needs: frame
// One index for light of all colours. The twin of eta_dispersed.wgsl.

fn eta_body(body: u32) -> f32 {
    return bodies[body].eta;
}
