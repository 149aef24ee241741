// `undeviated`: light goes straight on. The baseline that every method must beat.

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    return straight(v_ws);
}
