// needs: frame ray_line winding
// What a search along a line looks for, and what it has found: the first crossing
// after some place, or which of the crossings about the start lie ahead.
//
// Nothing moves an origin. A ray does not meet the triangle that it left; which of the
// crossings within rounding of its start lie ahead follows from what it is inside of:
// all crossings ahead must lead out of everything.

struct Hit {
    t: f32,
    id: u32,                    // of the triangle, or of the analytic body's entry or exit
    body: u32,                  // index into bodies; OPAQUE + index into paints
    entering: bool,
    cosine: f32,                // of the angle of incidence
    weights: vec2f,             // of the second and third corner
}

struct Near {
    t: f32,
    id: u32,
    solid: u32,
    entering: bool,
    ahead: bool,
}

const NO_ID: u32 = 0xffffffffu;
const OPAQUE: u32 = 16u;
const BEYOND: f32 = 1e30;       // t where there is no surface any more
const MOST_NEAR: u32 = 8u;

var<private> line: Line;
var<private> origin_rest_lc: vec3f;
var<private> departed_id: u32;
var<private> departed_inside: bool;
var<private> sees_opaque: bool;
// The line comes from the eye, which is outside of everything.
var<private> from_eye: bool;

// The search: crossings after (after_t, after_id), in boxes from search_low to search_high.
var<private> after_t: f32;
var<private> after_id: u32;
var<private> search_low: f32;
var<private> search_high: f32;
var<private> nearest: Hit;
var<private> second_t: f32;

// What surrounds the start: found by a search that sums.
var<private> summing: bool;
var<private> settled: bool;
var<private> far: Winding;
var<private> near: array<Near, 8>;
var<private> near_count: u32;

// Takes note of a crossing. `sure`: it lies ahead, whatever rounding did.
fn consider(hit: Hit, sure: bool) {
    if (hit.body >= OPAQUE && !sees_opaque) {
        return;
    }
    let blur = blur_m(line, hit.t, hit.cosine);
    if (summing) {
        sum_up(hit, blur, sure);
        return;
    }
    let in_doubt = settled && hit.t <= blur && !sure;
    if (hit.t >= BEYOND || (in_doubt && !is_ahead(hit.id))) {
        return;
    }
    if (hit.t < after_t || (hit.t == after_t && hit.id <= after_id && after_id != NO_ID)) {
        return;
    }
    if (hit.t < nearest.t || (hit.t == nearest.t && hit.id < nearest.id)) {
        second_t = nearest.t;
        nearest = hit;
    } else {
        second_t = min(second_t, hit.t);
    }
    search_high = select(nearest.t, min(second_t, nearest.t + grouped_m()), NESTED);
}

// How far apart crossings count as one.
fn grouped_m() -> f32 {
    return blur_m(line, nearest.t, max(nearest.cosine, 0.0625));
}

fn sum_up(hit: Hit, blur: f32, sure: bool) {
    if (hit.body >= OPAQUE) {
        return;
    }
    let solid = solid_of(hit.body);
    if (hit.t > blur || sure) {
        far = crossed(far, solid, hit.entering);
        return;
    }
    if (hit.t < -blur || near_count == MOST_NEAR) {
        return;
    }
    var place = near_count;
    while (place > 0u && near[place - 1u].t > hit.t) {
        near[place] = near[place - 1u];
        place -= 1u;
    }
    near[place] = Near(hit.t, hit.id, solid, hit.entering, hit.t > 0.0);
    near_count += 1u;
}

fn is_ahead(id: u32) -> bool {
    for (var i = 0u; i < near_count; i += 1u) {
        if (near[i].id == id) {
            return near[i].ahead;
        }
    }
    return false;
}

// Decides which crossings about the start lie ahead: for each solid the last ones of
// them, as many as lead out of it, and of several ways to do so the one nearest to
// what t says. Returns the winding that is then true.
fn settled_start(winding: Winding, known: bool) -> Winding {
    var start = winding;
    for (var solid = 0u; solid < SOLIDS; solid += 1u) {
        let wanted = -(count_of(winding, solid) + count_of(far, solid));
        var by_t = 0;
        for (var i = 0u; i < near_count; i += 1u) {
            by_t += select(0, step_of(near[i]), near[i].solid == solid && near[i].t > 0.0);
        }
        if (!known || !split_near(solid, wanted)) {
            start = with_count(start, solid, -(count_of(far, solid) + by_t));
        }
    }
    return start;
}

fn step_of(crossing: Near) -> i32 {
    return select(-1, 1, crossing.entering);
}

// Marks the last crossings of a solid near the start as ahead, if some number of them
// sums to what is wanted.
fn split_near(solid: u32, wanted: i32) -> bool {
    var sum = 0;
    var place = i32(near_count);
    var behind_by_t = 0;
    for (var i = 0u; i < near_count; i += 1u) {
        behind_by_t += select(0, 1, near[i].t <= 0.0);
    }
    var best = -1;
    loop {
        let closer = best < 0 || abs(place - behind_by_t) < abs(best - behind_by_t);
        if (sum == wanted && closer) {
            best = place;
        }
        if (place == 0) {
            break;
        }
        place -= 1;
        sum += select(0, step_of(near[place]), near[place].solid == solid);
    }
    if (best < 0) {
        return false;
    }
    for (var i = 0u; i < near_count; i += 1u) {
        if (near[i].solid == solid) {
            near[i].ahead = i32(i) >= best;
        }
    }
    return true;
}
