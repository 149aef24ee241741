// needs: ray_crossings ray_spot opaque
// Light from the opaque surface that a ray ends at. The twin of ray_opaque_none.wgsl.

const ANY_OPAQUE: bool = true;

fn opaque_met(hit: Hit, spot: Spot) -> vec3f {
    return light_of_surface(hit.body - OPAQUE, spot.p_lc, spot.normal_ws, line.d_ws);
}
