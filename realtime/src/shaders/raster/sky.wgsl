// needs: camera environment
// The environment behind everything: one triangle over the image.

@vertex
fn sky_vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn sky_light(at_px: vec2f) -> vec4f {
    return vec4f(environment(view_direction_ws(at_px)), 0.0);
}
