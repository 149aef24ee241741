// needs: frame
// Beer & Lambert. The twin of absorb_none.wgsl.

fn transmitted(path_m: f32, body: u32) -> vec3f {
    return exp(-bodies[body].absorption_per_m * path_m);
}
