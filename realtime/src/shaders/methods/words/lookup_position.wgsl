// needs: normal_cube
// Where the ray leaves the ball about the middle that reaches as far as the body
// does in the ray's direction: exact for a ball. An extension of ours, and the
// twin of lookup_direction.wgsl.

fn lookup_direction(from_middle: vec3f, d_ws: vec3f) -> vec3f {
    let radius_m = max(far_side(d_ws).w, length(from_middle));
    let b = dot(from_middle, d_ws);
    let t = -b + sqrt(max(b * b + radius_m * radius_m - dot(from_middle, from_middle), 0.0));
    return from_middle + t * d_ws;
}
