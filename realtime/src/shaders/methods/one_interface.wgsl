// `one-interface`: Snell's law at the first surface, and nothing at the second.

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let eta_effective = effective_index(eta_body(surface.body));
    let entered = enter(v_ws, surface, frame.eta_outside / eta_effective);
    return Trace(entered.d_ws, entered.d_ws, vec3f(0.0), 0.0, 1u, entered.flags);
}
