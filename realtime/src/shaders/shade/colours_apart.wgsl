// needs: environment absorption front trace method shade eta_dispersed
// Red and blue take ways of their own, beside the one already traced for green.

fn seen_through(pixel: vec2i, v_ws: vec3f, surface: Surface, traced: Trace) -> vec3f {
    var light = environment(traced.exit_ws) * transmitted(traced.path_m, surface.body);
    for (var c = 0u; c < 3u; c += 2u) {
        channel = c;
        let own = checked(trace(pixel, v_ws, surface), v_ws);
        light[c] = (environment(own.exit_ws) * transmitted(own.path_m, surface.body))[c];
    }
    channel = 1u;
    return light;
}
