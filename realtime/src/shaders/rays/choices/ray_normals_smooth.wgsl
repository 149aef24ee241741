// needs: ray_spot ray_crossings ray_tree ray_analytic surface_normal varyings
// Light bends at interpolated normals, and at those of bumps.
// The twin of ray_normals_flat.wgsl.

// Nine to a triangle: the normals of its corners.
@group(0) @binding(38) var<storage, read> ray_normals: array<f32>;

fn corner_normal(number: u32) -> vec3f {
    return vec3f(ray_normals[3u * number], ray_normals[3u * number + 1u], ray_normals[3u * number + 2u]);
}

// Paths may be caught for ever in total reflection: real surfaces do not do that.
const MAY_TRAP: bool = true;

fn shaded(spot: Spot, hit: Hit) -> Spot {
    var n_ws = spot.geometric_ws;
    if (hit.id < FIRST_ANALYTIC) {
        let a = corner_normal(3u * hit.id);
        let b = corner_normal(3u * hit.id + 1u);
        let c = corner_normal(3u * hit.id + 2u);
        let sum = (1.0 - spot.weights.x - spot.weights.y) * a + spot.weights.x * b + spot.weights.y * c;
        n_ws = select(n_ws, normalize(sum), dot(sum, sum) > 0.0);
    }
    if (hit.body < OPAQUE) {
        let v = Varyings(vec4f(0.0), spot.p_lc, n_ws, spot.geometric_ws, f32(hit.body) + 1.0, 0.0, vec4f(0.0));
        n_ws = surface_normal_ws(v);
    }
    return Spot(spot.p_lc, spot.rest_lc, spot.geometric_ws, n_ws, spot.weights);
}
