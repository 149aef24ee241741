// needs: frame back
// The back normal of the one texel under a position. The twin of n2_filter_bilinear.wgsl.

fn back_normal_near(at_px: vec2f) -> vec4f {
    let pixel = vec2i(floor(at_px));
    if (!in_image(pixel)) {
        return vec4f(0.0);
    }
    return back_normal_at(pixel);
}
