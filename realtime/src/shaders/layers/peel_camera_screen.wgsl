// needs: frame camera
// The layers are those of the image. The twin of peel_camera_fitted.wgsl.

fn peel_px(p_lc: vec3f) -> vec2f {
    return project_px(p_lc);
}

fn peel_depth_m(p_lc: vec3f) -> f32 {
    return depth_of_m(p_lc);
}

fn peel_footprint_m(depth_m: f32) -> f32 {
    return footprint_m(depth_m);
}

fn peel_size_px() -> vec2f {
    return frame.resolution_px;
}

fn peel_capacity() -> u32 {
    return frame.layer_capacity;
}
