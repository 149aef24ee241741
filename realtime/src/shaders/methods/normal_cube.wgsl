// title: back normals from a cube map of the body
// alias: M3n
// citation: @misc{Khan2004,
//   author = {A. Khan},
//   title = {Dual-sided Refraction Simulation},
//   note = {Shadertech contest, 2004; as described by Seipel and Nivfors, SIGRAD 2006}
// }
// needs: frame cube first_event interface eta lookup
// Bends at the first surface, takes the second normal from a cube of the body's normals
// in the direction of the ray, and bends again. Needs no second image of the body and no
// depth; the second surface is where the ray would leave from the middle, so what lies
// off the middle is bent wrongly. Wrong surfaces on concave bodies. Beside the exact
// image a ball about the middle shows what one-interface shows, for its far normals are
// the rays themselves.

// `normal-cube`: the normals of the body's far side, kept in a cube map about its
// middle. After Khan, "Dual-sided refraction simulation", Shadertech contest
// 2004, as Seipel & Nivfors (2006) describe it: the cube is looked up along the
// direction inside the body, as if the ray began in the middle.

@group(0) @binding(25) var normal_faces: texture_2d_array<f32>;  // xyz outward, w: metres from the middle

fn far_side(d_ws: vec3f) -> vec4f {
    let place = on_cube(d_ws);
    let size = vec2f(textureDimensions(normal_faces));
    let texel = vec2i(clamp(floor(place.at * size), vec2f(0.0), size - 1.0));
    return textureLoad(normal_faces, texel, place.face, 0);
}

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let eta_i_over_t = frame.eta_outside / eta_body(surface.body);
    let entered = enter(v_ws, surface, eta_i_over_t);
    let from_middle = surface.p_lc - frame.middle_lc;
    let towards = lookup_direction(from_middle, entered.d_ws);
    let second = far_side(towards);
    let found = second.w > 0.0;
    let hit2_lc = frame.middle_lc + second.w * normalize(towards);
    let n_ws = select(-surface.normal_ws, normalize(second.xyz), found);
    let outward_ws = select(n_ws, -n_ws, dot(entered.d_ws, n_ws) < 0.0);
    let left = bend(entered.d_ws, -outward_ws, 1.0 / eta_i_over_t);
    let flags = entered.flags | select(FLAG_FALLBACK, 0u, found)
        | select(0u, FLAG_TIR_CLAMPED, left.total);
    let path_m = select(0.0, distance(surface.p_lc, hit2_lc), found);
    return Trace(left.direction, entered.d_ws, hit2_lc, path_m, 2u, flags);
}
