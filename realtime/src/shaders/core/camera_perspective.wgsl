// needs: frame
// A pinhole. The twin of camera_orthographic.wgsl.

const PERSPECTIVE: bool = true;

fn view_direction_ws(position_px: vec2f) -> vec3f {
    let at = on_image_plane(position_px);
    return normalize(frame.forward_ws + at.x * frame.right_ws + at.y * frame.up_ws);
}

fn view_origin_lc(position_px: vec2f) -> vec3f {
    return frame.eye_lc;
}

// A point of a pixel's ray near the bodies, more precise than one far from them.
fn waist_of_ray_lc(position_px: vec2f) -> vec3f {
    let at = frame.waist_depth_m * on_image_plane(position_px);
    return frame.waist_lc + at.x * frame.right_ws + at.y * frame.up_ws;
}

fn direction_to_ws(p_lc: vec3f) -> vec3f {
    return normalize(p_lc - frame.eye_lc);
}

fn point_at_depth_lc(position_px: vec2f, depth_m: f32) -> vec3f {
    let at = on_image_plane(position_px);
    return frame.eye_lc + depth_m * (frame.forward_ws + at.x * frame.right_ws + at.y * frame.up_ws);
}

fn project_px(p_lc: vec3f) -> vec2f {
    let from_eye = p_lc - frame.eye_lc;
    let depth_m = max(dot(from_eye, frame.forward_ws), 1e-30);
    let at = vec2f(dot(from_eye, frame.right_ws), dot(from_eye, frame.up_ws)) / depth_m;
    return (at / frame.half_extent * vec2f(0.5, -0.5) + 0.5) * frame.resolution_px - frame.shift_px;
}

// Edge of a pixel at a depth.
fn footprint_m(depth_m: f32) -> f32 {
    return 2.0 * frame.half_extent.y / frame.resolution_px.y * depth_m;
}
