// needs: frame camera front trace method background absorption colours reflection
// needs: shown_cracks shown_air out_radiance out_exit out_first out_hit2 out_count
// One pixel: what a method says of the surface in front, or the background.

@compute @workgroup_size(8, 8)
fn shade(@builtin(global_invocation_id) id: vec3u) {
    let pixel = vec2i(id.xy);
    if (!in_image(pixel)) {
        return;
    }
    let v_ws = view_direction_ws(pixel_centre_px(pixel));
    if (body_number(pixel) == 0u || hidden(pixel)) {
        put_radiance(pixel, background(pixel, v_ws));
        return;
    }
    let surface = front_surface(pixel, v_ws);
    let traced = checked(trace(pixel, v_ws, surface), v_ws);
    put_radiance(pixel, vec4f(composite(pixel, v_ws, surface, traced), 1.0));
    put_exit(pixel, vec4f(traced.exit_ws, 1.0));
    put_first(pixel, vec4f(traced.first_ws, 1.0));
    put_hit2(pixel, vec4f(traced.hit2_lc, 1.0));
    put_count(pixel, vec4f(f32(traced.events), f32(traced.flags | surface.flags), traced.path_m, 1.0));
}

// What is not a number, or no direction, is flagged and goes straight on. A NaN
// fails every comparison.
fn checked(traced: Trace, v_ws: vec3f) -> Trace {
    let squared = dot(traced.exit_ws, traced.exit_ws);
    if (squared > 0.25 && squared < 4.0 && traced.path_m >= 0.0 && traced.path_m < 1e30) {
        return traced;
    }
    return Trace(v_ws, v_ws, vec3f(0.0), 0.0, traced.events, traced.flags | FLAG_NON_FINITE);
}

// Reflection and refraction mixed, the refracted part dimmed on its way.
fn composite(pixel: vec2i, v_ws: vec3f, surface: Surface, traced: Trace) -> vec3f {
    let share = reflected_share(v_ws, surface);
    let beyond = seen_through(pixel, v_ws, surface, traced);
    let through = with_cracks(pixel, with_air(pixel, beyond));
    return mix(through, reflected_light(v_ws, surface, share), share);
}
