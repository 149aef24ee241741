// needs: frame varyings depth_format depth_interval
// A point is inside the body if it lies between its nearest front side and its
// farthest back side: exact for convex bodies; elsewhere cracks also show in the
// air between two parts of the body.

fn is_inside(v: Varyings) -> bool {
    let pixel = vec2i(v.clip.xy);
    let z_m = depth_of_m(v.p_lc);
    let front_m = interval_front_m(pixel);
    let back_m = interval_back_m(pixel);
    let off_m = depth_error_m(z_m);
    return back_m > 0.0 && z_m >= front_m - off_m && z_m <= back_m + off_m;
}
