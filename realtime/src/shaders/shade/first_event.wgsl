// needs: interface front trace frame
// Entering the body at the surface a pixel sees.

struct Entered {
    d_ws: vec3f,
    flags: u32,
}

// If the transmitted or the reflected direction lies on the wrong side of the
// triangle, the whole event happens at the geometric normal.
fn enter(v_ws: vec3f, surface: Surface, eta_i_over_t: f32) -> Entered {
    let bent = bend(v_ws, surface.normal_ws, eta_i_over_t);
    let mirrored = reflect(v_ws, surface.normal_ws);
    let sound = dot(bent.direction, surface.geometric_ws) < 0.0
        && dot(mirrored, surface.geometric_ws) > 0.0;
    if (sound) {
        return Entered(bent.direction, select(0u, FLAG_TIR_CLAMPED, bent.total));
    }
    let again = bend(v_ws, surface.geometric_ws, eta_i_over_t);
    return Entered(again.direction,
        FLAG_GEOMETRIC_NORMAL | select(0u, FLAG_TIR_CLAMPED, again.total));
}

fn straight(v_ws: vec3f) -> Trace {
    return Trace(v_ws, v_ws, vec3f(0.0), 0.0, 0u, 0u);
}
