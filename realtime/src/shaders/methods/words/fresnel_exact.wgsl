// needs: interface
// Fresnel's formulae.

fn fresnel_share(d: vec3f, n: vec3f, eta_i: f32, eta_t: f32) -> f32 {
    return fresnel_exact(d, n, eta_i, eta_t);
}
