// needs: frame
// Clip planes around the bodies: the near one and the far one.

fn depth_planes_m() -> vec2f {
    return vec2f(max(dot(-frame.eye_lc, frame.forward_ws) - frame.radius_m, 1e-3 * frame.radius_m),
        dot(-frame.eye_lc, frame.forward_ws) + frame.radius_m);
}
