// needs: raster_analytic front_targets
// Analytic bodies with a depth test. Their depths are computed: there is no triangle.

struct AnalyticTargets {
    @builtin(frag_depth) depth: f32,
    @location(0) front_normal: vec4f,
    @location(1) front_depth: f32,
    @location(2) front_geometric: vec4f,
    @location(3) front_vector: vec4f,
    @location(4) front_thickness: f32,
}

@fragment
fn analytic_fragment(@builtin(position) at: vec4f) -> AnalyticTargets {
    let v = analytic_surface(at);
    let out = targets(v);
    return AnalyticTargets(
        depth_of_clip(v),
        out.front_normal,
        out.front_depth,
        out.front_geometric,
        out.front_vector,
        out.front_thickness,
    );
}
