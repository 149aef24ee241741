// needs: frame camera geometric_normal
// The surface a pixel's ray meets first.

@group(0) @binding(4) var front_normal: texture_2d<f32>;      // xyz, w: number of the body, 0 = none
@group(0) @binding(5) var front_depth: texture_2d<f32>;
@group(0) @binding(6) var front_geometric: texture_2d<f32>;

struct Surface {
    pixel: vec2i,
    p_lc: vec3f,
    normal_ws: vec3f,           // shading normal, faces the eye
    geometric_ws: vec3f,        // the triangle's own, faces the eye
    depth_m: f32,
    body: u32,                  // index into bodies
    flags: u32,
}

fn body_number(pixel: vec2i) -> u32 {
    return u32(textureLoad(front_normal, pixel, 0).w + 0.5);
}

// A shading normal that turns away from the eye is replaced by the geometric
// one, as the exact renderer does.
fn front_surface(pixel: vec2i, v_ws: vec3f) -> Surface {
    let stored = textureLoad(front_normal, pixel, 0);
    let depth_m = textureLoad(front_depth, pixel, 0).x;
    let geometric_ws = geometric_normal(pixel, stored.xyz);
    var surface: Surface;
    surface.pixel = pixel;
    surface.p_lc = point_at_depth_lc(pixel_centre_px(pixel), depth_m);
    surface.normal_ws = normalize(stored.xyz);
    surface.geometric_ws = geometric_ws;
    surface.depth_m = depth_m;
    surface.body = u32(stored.w + 0.5) - 1u;
    surface.flags = 0u;
    if (dot(v_ws, surface.normal_ws) >= 0.0) {
        surface.normal_ws = geometric_ws;
        surface.flags = FLAG_GEOMETRIC_NORMAL;
    }
    return surface;
}
