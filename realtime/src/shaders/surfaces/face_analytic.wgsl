// needs: raster_analytic face_targets
// Analytic bodies with a depth test. Their depths are computed: there is no triangle.

struct AnalyticTargets {
    @builtin(frag_depth) depth: f32,
    @location(0) face_light: vec4f,
}

@fragment
fn analytic_fragment(@builtin(position) at: vec4f) -> AnalyticTargets {
    let v = analytic_surface(at);
    let out = targets(v);
    return AnalyticTargets(
        depth_of_clip(v),
        out.face_light,
    );
}
