// needs: frame eta layers
// One kind of solid in the view: a point is inside while more interfaces that
// face the camera than interfaces that face away lie in front of it.
// The twin of media_nested.wgsl for scenes with one medium.

const MEDIUM_SURROUNDINGS: u32 = 0u;

fn medium_behind(pixel: vec2i, k: u32) -> u32 {
    var winding = 0;
    for (var j = 0u; j < k; j += 1u) {
        winding += select(-1, 1, layer_faces_camera(pixel, j));
    }
    return select(0u, 1u, winding > 0);
}

fn eta_of(medium: u32) -> f32 {
    return select(frame.eta_outside, eta_body(0), medium == 1u);
}

// Which way the surface between two media faces: true when its solid is ahead.
fn enters(medium_i: u32, medium_t: u32) -> bool {
    return medium_t > medium_i;
}

fn first_medium(body: u32) -> u32 {
    return 1u;
}
