// needs: environment absorption front trace
// Light of all colours takes one way. The twin of colours_apart.wgsl.

fn seen_through(pixel: vec2i, v_ws: vec3f, surface: Surface, traced: Trace) -> vec3f {
    return environment(traced.exit_ws) * transmitted(traced.path_m, surface.body);
}
