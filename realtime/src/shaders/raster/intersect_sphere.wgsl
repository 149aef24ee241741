// needs: raster_analytic
// Ball about the origin; size_m.x is its radius.

fn intersect(o: vec3f, d: vec3f) -> Met {
    let radius_m = analytic.size_m.x;
    let b = dot(o, d);
    // The ray's nearest point to the centre: no difference of large squares.
    let nearest = o - b * d;
    let h_2 = radius_m * radius_m - dot(nearest, nearest);
    let h = sqrt(max(h_2, 0.0));
    let n_near = (nearest - h * d) / radius_m;
    let n_far = (nearest + h * d) / radius_m;
    return Met(h_2 > 0.0, -b - h, -b + h, n_near, n_far);
}

fn inward_m(p: vec3f, n: vec3f) -> f32 {
    return 2.0 * analytic.size_m.x;
}
