// needs: raster_analytic
// Capped cylinder about the y axis; size_m.x is its radius, size_m.y half its height.

fn intersect(o: vec3f, d: vec3f) -> Met {
    let radius_m = analytic.size_m.x;
    let half_m = analytic.size_m.y;
    let across_2 = max(dot(d.xz, d.xz), 1e-30);
    let b = dot(o.xz, d.xz) / across_2;
    let nearest = o.xz - b * d.xz;
    let h_2 = radius_m * radius_m - dot(nearest, nearest);
    let h = sqrt(max(h_2, 0.0) / across_2);
    let dy = select(d.y, 1e-30, abs(d.y) < 1e-30);
    let cap_a = (-half_m - o.y) / dy;
    let cap_b = (half_m - o.y) / dy;
    let t_near = max(-b - h, min(cap_a, cap_b));
    let t_far = min(-b + h, max(cap_a, cap_b));
    let side_near = vec3f(o.x + t_near * d.x, 0.0, o.z + t_near * d.z) / radius_m;
    let side_far = vec3f(o.x + t_far * d.x, 0.0, o.z + t_far * d.z) / radius_m;
    let cap = vec3f(0.0, sign(d.y), 0.0);
    let n_near = select(side_near, -cap, min(cap_a, cap_b) > -b - h);
    let n_far = select(side_far, cap, max(cap_a, cap_b) < -b + h);
    return Met(h_2 > 0.0 && t_near < t_far, t_near, t_far, normalize(n_near), normalize(n_far));
}

fn inward_m(p: vec3f, n: vec3f) -> f32 {
    return select(2.0 * analytic.size_m.x, 2.0 * analytic.size_m.y, abs(n.y) > 0.5);
}
