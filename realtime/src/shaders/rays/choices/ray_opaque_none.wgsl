// needs: ray_crossings ray_spot
// Nothing opaque stands around the bodies. The twin of ray_opaque.wgsl.

const ANY_OPAQUE: bool = false;

fn opaque_met(hit: Hit, spot: Spot) -> vec3f {
    return vec3f(0.0);
}
