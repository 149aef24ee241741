// title: march through peeled layers, medium by winding
// alias: M4r
// citation: @misc{MaXiaoYang,
//   author = {Lei Ma and Shuangjiu Xiao and Xubo Yang},
//   title = {Multi-interfaces based Refractive Rendering},
//   note = {Shanghai Jiao Tong University}
// }
// needs: layers media march first_event interface eta tir parameters
// As multi-paper, but an interface is where the medium changes, counted from the layers
// in front. First order in the resolution of the layers; rays that turn sideways find no
// layer to hit. Beside the exact image everything seen through front and back is right;
// what should mirror totally is one flat colour or grain, and reflections on the outside
// are missing.

// `multi`: march a refracted ray through sorted layers and bend it wherever the
// medium under it changes. Ma, Xiao & Yang, "Multi-interfaces based refractive
// rendering", with the medium decided by winding instead of by layer number:
// when the index of the gap changes and the medium does not, the layers were
// renumbered at a silhouette and nothing happens (their look-back); when the
// medium changes, an interface was crossed from either side.

struct Crossing {
    before_lc: vec3f,           // last point still in the old medium
    after_lc: vec3f,            // first point in the new one
    medium: u32,                // the new one
    step_m: f32,                // length of the bracket that found it
    left: bool,                 // the ray left the image or the bounding sphere
    capped: bool,
}

fn medium_at(p_lc: vec3f) -> u32 {
    let pixel = pixel_of(p_lc);
    return medium_behind(pixel, layers_before(pixel, peel_depth_m(p_lc)));
}

// A step may cross one layer at most: halve it while it crosses two or more and
// is longer than half a pixel. What still differs by two there is a silhouette.
fn next_point(p_lc: vec3f, d_ws: vec3f) -> vec4f {
    let pixel = pixel_of(p_lc);
    let k = layers_before(pixel, peel_depth_m(p_lc));
    let shortest_m = 0.5 * peel_footprint_m(peel_depth_m(p_lc));
    let gap = gap_m(pixel, k, frame.radius_m) / LINEAR_PROBE_DIV;
    var step_m = clamp(gap, shortest_m, max(0.1 * frame.radius_m, shortest_m));
    var q_lc = p_lc + step_m * d_ws;
    while (step_m > shortest_m) {
        let k_q = layers_before(pixel_of(q_lc), peel_depth_m(q_lc));
        if (max(k, k_q) - min(k, k_q) < 2u) {
            break;
        }
        step_m = max(0.5 * step_m, shortest_m);
        q_lc = p_lc + step_m * d_ws;
    }
    return vec4f(q_lc, step_m);
}

fn find_crossing(start_lc: vec3f, d_ws: vec3f, medium: u32) -> Crossing {
    var p_lc = start_lc;
    var out = Crossing(start_lc, start_lc, medium, 0.0, false, false);
    for (var step = 0u; step < MAX_STEPS; step += 1u) {
        let next = next_point(p_lc, d_ws);
        if (!in_layers(pixel_of(next.xyz)) || outside_bodies(next.xyz)) {
            out.after_lc = next.xyz;
            out.left = true;
            return out;
        }
        let medium_next = medium_at(next.xyz);
        if (medium_next != medium) {
            return bisect(p_lc, next.xyz, medium, medium_next, next.w);
        }
        p_lc = next.xyz;
    }
    out.after_lc = p_lc;
    out.capped = true;
    return out;
}

fn bisect(low_lc: vec3f, high_lc: vec3f, medium: u32, found: u32, step_m: f32) -> Crossing {
    var low = low_lc;
    var high = high_lc;
    var medium_high = found;
    for (var i = 0u; i < BINARY_STEPS; i += 1u) {
        let middle = 0.5 * (low + high);
        let medium_middle = medium_at(middle);
        if (medium_middle == medium) {
            low = middle;
        } else {
            high = middle;
            medium_high = medium_middle;
        }
    }
    return Crossing(low, high, medium_high, step_m, false, false);
}

// Outward normal of the layer nearest in depth whose side fits the transition.
// w = 0 when none is near enough: the ray met a wall that the layers do not
// hold, and Wyman's fallback (perpendicular to the viewing axis) stands in.
fn normal_at_crossing(crossing: Crossing, d_ws: vec3f, entering: bool) -> vec4f {
    let pixel = pixel_of(crossing.after_lc);
    let z_m = peel_depth_m(crossing.after_lc);
    var nearest_m = max(0.05 * frame.radius_m, 2.0 * crossing.step_m);
    var normal = vec4f(0.0);
    for (var j = 0u; j < layer_count(pixel); j += 1u) {
        let n_ws = layer_normal_ws(pixel, j);
        let distance_m = abs(layer_depth_m(pixel, j) - z_m);
        if ((dot(d_ws, n_ws) < 0.0) == entering && distance_m <= nearest_m) {
            nearest_m = distance_m;
            normal = vec4f(n_ws, 1.0);
        }
    }
    if (normal.w == 0.0) {
        return vec4f(wall_normal(d_ws, entering), 0.0);
    }
    return normal;
}

fn wall_normal(d_ws: vec3f, entering: bool) -> vec3f {
    let sideways = d_ws - dot(frame.forward_ws, d_ws) * frame.forward_ws;
    let length_2 = dot(sideways, sideways);
    let outward = select(d_ws, sideways * inverseSqrt(max(length_2, 1e-20)), length_2 > 1e-12);
    return select(outward, -outward, entering);
}

fn march(start_lc: vec3f, start_d_ws: vec3f, start_medium: u32) -> Chain {
    var chain = Chain(start_lc, start_d_ws, vec3f(0.0), 0.0, 1u, 0u, 0u, 0u);
    var medium = start_medium;
    // Half a pixel along the ray: the first layer is behind us now.
    chain.p_lc += 0.5 * peel_footprint_m(peel_depth_m(start_lc)) * start_d_ws;
    loop {
        if (chain.events >= MAX_EVENTS) {
            chain.flags |= FLAG_CAP;
            break;
        }
        let crossing = find_crossing(chain.p_lc, chain.d_ws, medium);
        if (medium != MEDIUM_SURROUNDINGS) {
            chain.path_m += distance(chain.p_lc, crossing.after_lc);
        }
        if (crossing.capped) {
            chain.flags |= FLAG_CAP;
        }
        if (crossing.left || crossing.capped) {
            if (medium != MEDIUM_SURROUNDINGS) {
                leave_lost(&chain, medium);
            }
            chain.p_lc = crossing.after_lc;
            break;
        }
        if (!cross_interface(&chain, crossing, &medium)) {
            break;
        }
    }
    return chain;
}

// The search ended inside: refract out through a wall and say so.
fn leave_lost(chain: ptr<function, Chain>, medium: u32) {
    let n_ws = wall_normal((*chain).d_ws, false);
    let out = bend((*chain).d_ws, -n_ws, eta_of(medium) / eta_of(MEDIUM_SURROUNDINGS));
    (*chain).d_ws = out.direction;
    (*chain).flags |= FLAG_LOST;
}

// Bends the chain at a crossing. False when no further event is allowed.
fn cross_interface(chain: ptr<function, Chain>, crossing: Crossing, medium: ptr<function, u32>) -> bool {
    let eta_i = eta_of(*medium);
    let eta_t = eta_of(crossing.medium);
    let entering = enters(*medium, crossing.medium);
    let d_ws = (*chain).d_ws;
    let normal = normal_at_crossing(crossing, d_ws, entering);
    if (normal.w == 0.0) {
        (*chain).flags |= FLAG_FALLBACK;
    }
    let against = select(-normal.xyz, normal.xyz, dot(d_ws, normal.xyz) < 0.0);
    let bent = bend(d_ws, against, eta_i / eta_t);
    (*chain).events += 1u;
    if ((*chain).events == 2u) {
        (*chain).hit2_lc = crossing.after_lc;
    }
    if (bent.total && REFLECT_TOTAL) {
        (*chain).total_reflections += 1u;
        if ((*chain).total_reflections > MAX_TOTAL_REFLECTIONS) {
            (*chain).flags |= FLAG_CAP;
            (*chain).p_lc = crossing.before_lc;
            return false;
        }
        (*chain).d_ws = reflect(d_ws, against);
        (*chain).p_lc = crossing.before_lc;
        return true;
    }
    if (bent.total) {
        (*chain).flags |= FLAG_TIR_CLAMPED;
    }
    (*chain).d_ws = bent.direction;
    (*chain).p_lc = crossing.after_lc
        + 0.5 * peel_footprint_m(peel_depth_m(crossing.after_lc)) * bent.direction;
    *medium = crossing.medium;
    return true;
}

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let entered = enter(v_ws, surface, frame.eta_outside / eta_body(surface.body));
    let chain = march(surface.p_lc, entered.d_ws, first_medium(surface.body));
    return Trace(chain.d_ws, entered.d_ws, chain.hit2_lc, chain.path_m, chain.events,
        entered.flags | chain.flags | layer_flags());
}
