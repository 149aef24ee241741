// title: no refraction
// alias: M0
// needs: first_event
// one way for all colours
// Light goes straight through. What every method must beat; exact for thin parallel
// plates. Seen beside the exact image, the body is simply not there.

// `undeviated`: light goes straight on. The baseline that every method must beat.

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    return straight(v_ws);
}
