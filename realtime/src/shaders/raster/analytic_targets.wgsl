// needs: raster_analytic targets
// Analytic bodies in a pass whose targets() say all there is to write.

@fragment
fn analytic_fragment(@builtin(position) at: vec4f) -> Targets {
    return targets(analytic_surface(at));
}
