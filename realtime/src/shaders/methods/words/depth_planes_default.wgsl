// Clip planes that know nothing of the scene. The twin of depth_planes_fitted.wgsl.

fn depth_planes_m() -> vec2f {
    return vec2f(0.1, 1000.0);
}
