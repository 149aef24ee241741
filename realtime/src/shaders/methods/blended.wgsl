// title: blended front and back normals
// alias: M2
// citation: @inproceedings{SeipelNivfors2006,
//   author = {Stefan Seipel and Anders Nivfors},
//   title = {Efficient Rendering of Multiple Refractions and Reflections in Natural Objects},
//   booktitle = {SIGRAD 2006},
//   year = {2006}
// }
// needs: frame front trace eta eye parameters a
// one way for all colours
// One bend at a mixture of the front normal and the back normal seen through the same
// pixel. As printed it weakens refraction: good for ice cubes, wrong for lenses. No total
// reflection inside. Beside the exact image a ball is a nearly clear disc, upper faces
// are too bright where eq. 4 overrates the reflection, and nothing mirrors inside.

// `blended`: Seipel & Nivfors, "Efficient rendering of multiple refractions and
// reflections in natural objects", 2006. Front and back normals are mixed
// (eq. 1) and light is bent once at the mixture (eq. 2).

fn trace(pixel: vec2i, view_ws: vec3f, surface: Surface) -> Trace {
    let v_ws = eye_vector(pixel, view_ws);
    let eta_i_over_t = frame.eta_outside / eta_body(surface.body);
    let n_r = blended_normal(pixel, v_ws, surface.normal_ws);
    let c = dot(n_r, v_ws);
    let k = 1.0 - eta_i_over_t * eta_i_over_t * (1.0 - c * c);
    // Eq. 2 as printed: n_r is not turned towards the eye.
    let r = eta_i_over_t * v_ws - (eta_i_over_t * c + sqrt(max(k, 0.0))) * n_r;
    let d_ws = normalize(r);
    let flags = flag_back(pixel, surface.body) | select(0u, FLAG_TIR_CLAMPED, k < 0.0);
    return Trace(d_ws, d_ws, vec3f(0.0), 0.0, 1u, flags);
}
