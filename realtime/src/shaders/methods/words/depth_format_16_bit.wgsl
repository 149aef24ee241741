// needs: frame depth_planes
// A depth as a 16-bit depth buffer keeps it: its steps grow with the square of
// the distance and with the span of the clip planes.

fn stored_depth_m(z_m: f32) -> f32 {
    let planes = depth_planes_m();
    let span = planes.y - planes.x;
    let ndc = planes.y * (z_m - planes.x) / (z_m * span);
    let kept = round(clamp(ndc, 0.0, 1.0) * 65535.0) / 65535.0;
    return planes.x * planes.y / (planes.y - kept * span);
}

// Half a step of the buffer.
fn depth_error_m(z_m: f32) -> f32 {
    let planes = depth_planes_m();
    return 0.5 * z_m * z_m * (planes.y - planes.x) / (planes.x * planes.y * 65535.0);
}
