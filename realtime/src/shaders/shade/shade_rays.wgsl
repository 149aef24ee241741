// needs: frame method ray_path ray_colours ray_constants out_radiance out_exit out_first out_hit2 out_count
// One pixel of a method that follows rays by itself: nothing is drawn before it.

@compute @workgroup_size(8, 8)
fn shade(@builtin(global_invocation_id) id: vec3u) {
    let pixel = vec2i(id.xy);
    if (!in_image(pixel)) {
        return;
    }
    // The layers' path comes first, then those of the light, unless it is the same.
    let shared_path = RAY_SAMPLES == 0u && RAY_CHANNELS == 1u && !ANY_OPAQUE;
    let of_light = max(RAY_SAMPLES, 1u) * RAY_CHANNELS;
    let first = select(1u, 0u, RAY_LAYERS || shared_path);
    let count = select(1u, 1u + of_light, RAY_LIGHT && !shared_path);
    var light = vec3f(0.0);
    var met = false;
    for (var number = first; number < count; number += 1u) {
        let for_layers = number == 0u;
        let of_channel = select(1u, (number - 1u) % RAY_CHANNELS, !for_layers && RAY_CHANNELS == 3u);
        choose_channel(of_channel);
        sees_opaque = !for_layers;
        begin_chance(pixel, (number - 1u) / RAY_CHANNELS, RAY_SEED);
        let path = followed(pixel, RAY_SAMPLES > 0u && !for_layers);
        if (for_layers) {
            put_layers(pixel, path);
        }
        if (!for_layers || shared_path) {
            let own = vec3f(f32(of_channel == 0u), f32(of_channel == 1u), f32(of_channel == 2u));
            light += select(vec3f(1.0), own, RAY_CHANNELS == 3u) * finite(path.light);
            met = met || path.met;
        }
    }
    put_radiance(pixel, vec4f(light / f32(max(RAY_SAMPLES, 1u)), f32(met)));
}

// A NaN fails every comparison.
fn finite(light: vec3f) -> vec3f {
    return select(vec3f(0.0), light, abs(light) < vec3f(1e30));
}

fn put_layers(pixel: vec2i, path: Path) {
    let written = path.events > 0u;
    let leaves = select(0.0, 1.0, written && path.left);
    put_exit(pixel, vec4f(path.flight.d_ws, 1.0) * leaves);
    put_first(pixel, vec4f(path.first_ws, f32(written)));
    put_hit2(pixel, vec4f(path.hit2_lc, f32(written)));
    put_count(pixel, vec4f(f32(path.events), f32(path.flags), path.path_m, 1.0) * f32(written));
}
