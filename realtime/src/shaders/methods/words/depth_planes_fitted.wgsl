// needs: frame
// Clip planes around the bodies: the near one and the far one.

fn depth_planes_m() -> vec2f {
    let middle_m = dot(frame.ball_lc - frame.eye_lc, frame.forward_ws);
    return vec2f(max(middle_m - frame.radius_m, 1e-3 * frame.radius_m), middle_m + frame.radius_m);
}
