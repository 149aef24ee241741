// needs: interface
// Schlick's approximation.

fn fresnel_share(d: vec3f, n: vec3f, eta_i: f32, eta_t: f32) -> f32 {
    return fresnel_schlick(d, n, eta_i, eta_t);
}
