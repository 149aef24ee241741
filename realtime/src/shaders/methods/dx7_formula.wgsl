// needs: a
// The vector of "Fake refraction in DX7", R(a) = (1 - a)(N·E)N - E with E towards
// the eye: a = -1 mirrors, a = 1 goes straight on.

fn dx7_vector(v_ws: vec3f, n_ws: vec3f, eta: f32) -> vec3f {
    let towards_eye = -v_ws;
    let a = dx7_a(eta);
    return (1.0 - a) * dot(n_ws, towards_eye) * n_ws - towards_eye;
}
