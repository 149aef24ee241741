// title: fake refraction, per pixel
// alias: M1b
// citation: @misc{FakeRefraction2000,
//   title = {Approximating Refraction: Fake Refraction in DX7},
//   year = {2000},
//   note = {cube maps indexed by R = (1 - a)(N.E)N - E}
// }
// needs: frame front trace eta index dx7_formula
// one way for all colours
// The same formula at every pixel. Bends the wrong way with the printed 1/n; no second
// interface, no parallax. Beside the exact image the sky stands upright in the upper half
// of a ball where it should hang below.

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let eta = effective_index(eta_body(surface.body)) / frame.eta_outside;
    let d_ws = normalize(dx7_vector(v_ws, surface.normal_ws, eta));
    return Trace(d_ws, d_ws, vec3f(0.0), 0.0, 1u, 0u);
}
