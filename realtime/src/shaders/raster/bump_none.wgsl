// needs: varyings
// Surfaces without bumps.

fn surface_normal_ws(v: Varyings) -> vec3f {
    return normalize(v.normal_ws);
}
