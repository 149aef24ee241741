// needs: frame back
// The mean of the four back normals around a position; texels without a surface
// count neither in the sum nor, below a half, at all.

fn back_normal_near(at_px: vec2f) -> vec4f {
    let low = floor(at_px - 0.5);
    let f = at_px - 0.5 - low;
    let i = vec2i(low);
    let top = mix(back_normal_inside(i), back_normal_inside(i + vec2i(1, 0)), f.x);
    let bottom = mix(back_normal_inside(i + vec2i(0, 1)), back_normal_inside(i + vec2i(1, 1)), f.x);
    return mix(top, bottom, f.y);
}

fn back_normal_inside(pixel: vec2i) -> vec4f {
    if (!in_image(pixel)) {
        return vec4f(0.0);
    }
    let stored = back_normal_at(pixel);
    return select(vec4f(0.0), vec4f(stored.xyz, 1.0), stored.w >= 0.5);
}
