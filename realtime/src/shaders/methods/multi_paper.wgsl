// title: march through peeled layers, as published
// alias: M4p
// citation: @misc{MaXiaoYang,
//   author = {Lei Ma and Shuangjiu Xiao and Xubo Yang},
//   title = {Multi-interfaces based Refractive Rendering},
//   note = {Shanghai Jiao Tong University}
// }
// needs: layers media march first_event interface eta parameters
// Walks from layer to layer by number, with the repairs without which the printed listing
// does not run. Wrong where the ray crosses an interface sideways: walls of shells,
// bubbles. Beside the exact image a cup is right down to its base, where the chain
// breaks; side faces that should mirror show one flat colour.

// `multi-paper`: the look-back march of Ma, Xiao & Yang as printed, with the
// repairs without which it does not run: the inner loop's comparison is turned
// round, depths are sampled again at the pixel the point projects to, and the
// refraction that the listing leaves out happens after the binary search.
// The medium alternates with the facing of the layer that was met.
// `n` is the number of the last
// interface behind the point, counted from 1 as in the paper.

fn paper_gap_end_m(p_lc: vec3f, n: u32) -> f32 {
    let pixel = pixel_of(p_lc);
    return select(EMPTY_DEPTH, layer_depth_m(pixel, n), n < layer_count(pixel));
}

fn march_paper(start_lc: vec3f, start_d_ws: vec3f, eta_inside: f32, eta_outside: f32) -> Chain {
    var chain = Chain(start_lc, start_d_ws, vec3f(0.0), 0.0, 1u, 0u, 0u, 0u);
    var n = 1u;
    var steps = 0u;
    var inside = true;
    var begun = false;
    let tolerance_m = 1e-5 * frame.radius_m;
    let shortest_m = 0.5 * peel_footprint_m(peel_depth_m(start_lc));
    loop {
        if (chain.events >= MAX_EVENTS || steps >= MAX_STEPS) {
            chain.flags |= FLAG_CAP;
            break;
        }
        steps += 1u;
        chain.steps += 1u;
        let pixel = pixel_of(chain.p_lc);
        if (!in_layers(pixel) || n >= layer_count(pixel) || n < 1u) {
            break;
        }
        let near_m = layer_depth_m(pixel, n - 1u);
        let far_m = layer_depth_m(pixel, n);
        // Layers of another camera than the image's may begin a little behind the
        // surface: only a point that was behind its layer can come before it again.
        let before = peel_depth_m(chain.p_lc) < near_m - tolerance_m;
        if (before && begun) {
            n -= 1u;
            continue;
        }
        begun |= !before;
        let step_m = max((far_m - near_m) / LINEAR_PROBE_DIV, shortest_m);
        let q_lc = chain.p_lc + step_m * chain.d_ws;
        if (!in_layers(pixel_of(q_lc)) || peel_depth_m(q_lc) < paper_gap_end_m(q_lc, n)) {
            chain.path_m += select(0.0, step_m, inside);
            chain.p_lc = q_lc;
            continue;
        }
        meet_next_layer(&chain, q_lc, n, eta_inside, eta_outside);
        inside = !inside;
        n += 1u;
        steps = 0u;
    }
    return chain;
}

// Binary search for layer n + 1 between the chain's point and q, then eq. 2 with
// the normal found there. Total reflection is clamped to the tangent.
fn meet_next_layer(chain: ptr<function, Chain>, q_lc: vec3f, n: u32, eta_inside: f32,
                   eta_outside: f32) {
    var low = (*chain).p_lc;
    var high = q_lc;
    for (var i = 0u; i < BINARY_STEPS; i += 1u) {
        let middle = 0.5 * (low + high);
        if (peel_depth_m(middle) < paper_gap_end_m(middle, n)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let d_ws = (*chain).d_ws;
    let n_ws = layer_normal_ws(pixel_of(high), n);
    // A body of lower index inside is a hole: its boundary is the glass's, turned round.
    let against = dot(d_ws, n_ws) < 0.0;
    let hole = eta_of(layer_solid(pixel_of(high), n) + 1u) < eta_inside;
    let eta_i_over_t = select(eta_inside / eta_outside, eta_outside / eta_inside, against != hole);
    let bent = bend(d_ws, select(-n_ws, n_ws, against), eta_i_over_t);
    if (bent.total) {
        (*chain).flags |= FLAG_TIR_CLAMPED;
    }
    (*chain).path_m += distance((*chain).p_lc, high);
    (*chain).p_lc = high;
    (*chain).d_ws = bent.direction;
    (*chain).events += 1u;
    if ((*chain).events == 2u) {
        (*chain).hit2_lc = high;
    }
}

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let eta_inside = eta_body(surface.body);
    let entered = enter(v_ws, surface, frame.eta_outside / eta_inside);
    let chain = march_paper(surface.p_lc, entered.d_ws, eta_inside, frame.eta_outside);
    return Trace(chain.d_ws, entered.d_ws, chain.hit2_lc, chain.path_m, chain.events,
        entered.flags | chain.flags | layer_flags());
}
