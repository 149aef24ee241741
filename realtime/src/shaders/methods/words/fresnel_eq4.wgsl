// needs: interface
// bends at equal index
// Eq. 4 of Seipel & Nivfors.

fn fresnel_share(d: vec3f, n: vec3f, eta_i: f32, eta_t: f32) -> f32 {
    return fresnel_cubed(d, n);
}
