// needs: frame camera background out_radiance
// No body is in the image. The twin of shade.wgsl.

@compute @workgroup_size(8, 8)
fn shade(@builtin(global_invocation_id) id: vec3u) {
    let pixel = vec2i(id.xy);
    if (!in_image(pixel)) {
        return;
    }
    put_radiance(pixel, background(pixel, view_direction_ws(pixel_centre_px(pixel))));
}
