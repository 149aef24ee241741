// needs: frame camera ray_spot
// Places in whole numbers of a small unit: sums of them are exact, and stay so whatever a
// compiler makes of them. A place is a float and the little that it leaves out.

// Largest coordinate in units; what lies farther away is a float alone.
const MOST_UNITS: f32 = 1.073741824e9;

fn fixed(v: vec3f) -> vec3i {
    return vec3i(round(v / frame.unit_m));
}

fn is_fixed(v_lc: vec3f) -> bool {
    let size = abs(v_lc);
    return max(max(size.x, size.y), size.z) < MOST_UNITS * frame.unit_m;
}

// What a float leaves out of a place.
fn left_out(place: vec3i, p_lc: vec3f) -> vec3f {
    return vec3f(place - fixed(p_lc)) * frame.unit_m;
}

// The upper half of a number's digits, so that products of halves are exact.
fn upper_half(v: vec3f) -> vec3f {
    return bitcast<vec3f>(bitcast<vec3u>(v) & vec3u(0xfffff000u));
}

// Where a ray has come to after t.
fn place_along(origin: vec3i, d_ws: vec3f, t: f32) -> vec3i {
    let d_upper = upper_half(d_ws);
    let d_lower = d_ws - d_upper;
    let t_upper = upper_half(vec3f(t));
    let t_lower = vec3f(t) - t_upper;
    return origin + fixed(t_upper * d_upper) + fixed(t_upper * d_lower)
        + fixed(t_lower * d_upper) + fixed(t_lower * d_lower);
}

// A place on a pixel's ray near the bodies.
fn waist_of_pixel(pixel: vec2i) -> Place {
    let p_lc = waist_of_ray_lc(pixel_centre_px(pixel));
    if (!is_fixed(p_lc)) {
        return Place(p_lc, vec3f(0.0));
    }
    let halves = 2 * pixel + 1;
    let rest = vec3f(f32(halves.x)) * frame.across_rest + vec3f(f32(halves.y)) * frame.down_rest;
    let place = frame.waist_fixed + vec3i(halves.x) * frame.across_fixed
        + vec3i(halves.y) * frame.down_fixed + vec3i(round(rest));
    return Place(p_lc, left_out(place, p_lc));
}
