// needs: raster_analytic
// Box about the origin; size_m.xyz are its half extents, infinite ones allowed.
// Kay & Kajiya, "Ray tracing complex scenes", 1986.

fn intersect(o: vec3f, d: vec3f) -> Met {
    let inverse = 1.0 / select(d, vec3f(1e-30), abs(d) < vec3f(1e-30));
    let a = (-analytic.size_m.xyz - o) * inverse;
    let b = (analytic.size_m.xyz - o) * inverse;
    let near = min(a, b);
    let far = max(a, b);
    let t_near = max(max(near.x, near.y), near.z);
    let t_far = min(min(far.x, far.y), far.z);
    let n_near = -sign(d) * step(vec3f(t_near), near);
    let n_far = sign(d) * step(far, vec3f(t_far));
    return Met(t_near < t_far, t_near, t_far, normalize(n_near), normalize(n_far));
}

fn inward_m(p: vec3f, n: vec3f) -> f32 {
    return 2.0 * dot(abs(n), analytic.size_m.xyz);
}
