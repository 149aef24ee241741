// `dx7`: the vector of "Fake refraction in DX7", R(a) = (1 - a)(N·E)N - E with E
// towards the eye: a = -1 mirrors, a = 1 goes straight on. The printed a = 1/n
// bends away from the normal, against Snell; a = n bends towards it.

fn dx7_vector(v_ws: vec3f, n_ws: vec3f, eta: f32) -> vec3f {
    let towards_eye = -v_ws;
    let a = dx7_a(eta);
    return (1.0 - a) * dot(n_ws, towards_eye) * n_ws - towards_eye;
}

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let eta = effective_index(eta_body(surface.body)) / frame.eta_outside;
    let d_ws = normalize(dx7_vector(v_ws, surface.normal_ws, eta));
    return Trace(d_ws, d_ws, vec3f(0.0), 0.0, 1u, 0u);
}
