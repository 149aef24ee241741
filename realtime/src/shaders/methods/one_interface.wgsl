// title: Snell's law at the first surface
// alias: M1c
// citation: @misc{FakeRefraction2000,
//   title = {Approximating Refraction: Fake Refraction in DX7},
//   year = {2000},
//   note = {cube maps indexed by R = (1 - a)(N.E)N - E}
// }
// needs: frame first_event eta index
// one way for all colours
// Exact at the first surface, nothing at the second: a slab turns light that it should
// only shift, a ball refracts half of what it should. Beside the exact image the picture
// in a ball is blurred by too little inversion, each face of a box shows one bent view
// where it should mirror, and there are no highlights.

// `one-interface`: Snell's law at the first surface, and nothing at the second.

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let eta_effective = effective_index(eta_body(surface.body));
    let entered = enter(v_ws, surface, frame.eta_outside / eta_effective);
    return Trace(entered.d_ws, entered.d_ws, vec3f(0.0), 0.0, 1u, entered.flags);
}
