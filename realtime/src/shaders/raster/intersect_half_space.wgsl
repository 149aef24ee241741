// needs: raster_analytic
// Everything below y = 0.

fn intersect(o: vec3f, d: vec3f) -> Met {
    let dy = select(d.y, 1e-30, abs(d.y) < 1e-30);
    let t = -o.y / dy;
    let up = vec3f(0.0, 1.0, 0.0);
    if (d.y < 0.0) {
        return Met(true, t, 1e30, up, -d);
    }
    return Met(o.y < 0.0, -1e30, t, -d, up);
}

fn inward_m(p: vec3f, n: vec3f) -> f32 {
    return 0.0;
}
