// A point is inside the body if it lies between its nearest front side and its
// farthest back side: exact for convex bodies; elsewhere cracks also show in the
// air between two parts of the body.

@group(0) @binding(23) var CLIP_FRONT: texture_2d<f32>;
@group(0) @binding(24) var CLIP_BACK: texture_2d<f32>;

fn is_inside(v: Varyings) -> bool {
    let pixel = vec2i(v.clip.xy);
    let z_m = depth_of_m(v.p_lc);
    let front_m = textureLoad(CLIP_FRONT, pixel, 0).x;
    let back_m = textureLoad(CLIP_BACK, pixel, 0).x;
    let off_m = depth_error_m(z_m);
    return back_m > 0.0 && z_m >= front_m - off_m && z_m <= back_m + off_m;
}
