// The viewing direction of the pixel. The twin of eye_per_vertex.wgsl.

fn eye_vector(pixel: vec2i, v_ws: vec3f) -> vec3f {
    return v_ws;
}
