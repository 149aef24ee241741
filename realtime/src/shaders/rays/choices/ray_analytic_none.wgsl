// needs: ray_crossings ray_spot
// Every body is a mesh. The twin of ray_analytic.wgsl.

const FIRST_ANALYTIC: u32 = 0x80000000u;

fn meet_analytic() {}

fn spot_on_analytic(hit: Hit) -> Spot {
    return Spot(line.origin_lc, vec3f(0.0), -line.d_ws, -line.d_ws, vec2f(0.0));
}
