// title: two interfaces in image space
// alias: M3
// citation: @inproceedings{Wyman2005,
//   author = {Chris Wyman},
//   title = {An Approximate Image-Space Approach for Interactive Refraction},
//   booktitle = {ACM SIGGRAPH 2005},
//   pages = {1050--1053},
//   year = {2005}
// }
// needs: frame first_event interface eta back distance n2_filter
// Bends at the first surface, guesses the distance to the second from two known ones, and
// bends again at the back normal found there. A ring of clamped total reflection near a
// ball's limb; wrong surfaces on concave bodies. Beside the exact image a cup looks like
// a solid lens, faces of a box that should mirror are one flat colour, and highlights are
// missing.

// `two-interface`: Wyman, "An approximate image-space approach for interactive
// refraction", SIGGRAPH 2005. The distance to the second surface is guessed
// from two distances known beforehand: d_V straight along the view, from the
// depth buffers, and d_N along the inward normal, from a ray per vertex.

@group(0) @binding(11) var front_thickness: texture_2d<f32>;

// The weight of d_V is theta_t / theta_i: 1 as the index goes to 1, when light
// goes straight on, and 0 as it goes to infinity, when it follows the normal.
fn view_weight(v_ws: vec3f, n_ws: vec3f, d_ws: vec3f, eta_i_over_t: f32) -> f32 {
    let theta_i = atan2(length(cross(v_ws, n_ws)), -dot(v_ws, n_ws));
    let theta_t = atan2(length(cross(d_ws, n_ws)), -dot(d_ws, n_ws));
    return select(theta_t / theta_i, eta_i_over_t, theta_i < 1e-4);
}

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let eta_i_over_t = frame.eta_outside / eta_body(surface.body);
    let entered = enter(v_ws, surface, eta_i_over_t);
    let d_view_m = max(back_depth_at_m(pixel) - surface.depth_m, 0.0) / dot(v_ws, frame.forward_ws);
    let d_normal_m = textureLoad(front_thickness, pixel, 0).x;
    let w = view_weight(v_ws, surface.normal_ws, entered.d_ws, eta_i_over_t);
    let distance_m = guessed_distance_m(w, d_view_m, d_normal_m);
    let hit2_lc = surface.p_lc + clamp(distance_m, 0.0, 2.0 * frame.radius_m) * entered.d_ws;
    let second = second_normal(project_px(hit2_lc), entered.d_ws, surface.normal_ws);
    let left = bend(entered.d_ws, -second.n_ws, 1.0 / eta_i_over_t);
    let flags = entered.flags | second.flags | flag_other_body(pixel, surface.body) | select(0u, FLAG_TIR_CLAMPED, left.total);
    return Trace(left.direction, entered.d_ws, hit2_lc, distance(surface.p_lc, hit2_lc), 2u, flags);
}

struct Second {
    n_ws: vec3f,                // outward, dot(d, n) > 0
    flags: u32,
}

// Beyond the silhouette there is no second surface: Wyman lets the ray leave
// perpendicular to the viewing axis.
fn second_normal(at_px: vec2f, d_ws: vec3f, first_n_ws: vec3f) -> Second {
    let stored = back_normal_near(at_px);
    if (stored.w < 0.5) {
        let sideways = d_ws - dot(frame.forward_ws, d_ws) * frame.forward_ws;
        let n_ws = select(-first_n_ws, normalize(sideways), dot(sideways, sideways) > 1e-12);
        return Second(n_ws, FLAG_FALLBACK);
    }
    let n_ws = normalize(stored.xyz);
    return Second(select(n_ws, -n_ws, dot(d_ws, n_ws) < 0.0), 0u);
}
