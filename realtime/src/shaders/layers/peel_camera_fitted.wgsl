// needs: frame camera
// The layers have a camera of their own, fitted to the bodies: it also holds
// what lies outside the image. The twin of peel_camera_screen.wgsl.

// Storage: lavapipe of Mesa 22.3 crashes on a fourth uniform buffer in a compute pass.
@group(0) @binding(28) var<storage, read> peel_frame: Frame;

fn peel_px(p_lc: vec3f) -> vec2f {
    let from_eye = p_lc - peel_frame.eye_lc;
    let depth_m = max(dot(from_eye, peel_frame.forward_ws), 1e-30);
    let aside = vec2f(dot(from_eye, peel_frame.right_ws), dot(from_eye, peel_frame.up_ws));
    let at = aside / select(1.0, depth_m, PERSPECTIVE);
    return (at / peel_frame.half_extent * vec2f(0.5, -0.5) + 0.5) * peel_frame.resolution_px;
}

fn peel_depth_m(p_lc: vec3f) -> f32 {
    return dot(p_lc - peel_frame.eye_lc, peel_frame.forward_ws);
}

fn peel_footprint_m(depth_m: f32) -> f32 {
    let edge = 2.0 * peel_frame.half_extent.y / peel_frame.resolution_px.y;
    return edge * select(1.0, depth_m, PERSPECTIVE);
}

fn peel_size_px() -> vec2f {
    return peel_frame.resolution_px;
}

fn peel_capacity() -> u32 {
    return peel_frame.layer_capacity;
}
