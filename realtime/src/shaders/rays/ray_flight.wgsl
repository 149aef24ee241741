// needs: ray_line ray_crossings ray_tree ray_analytic winding absorption ray_constants
// From where a ray is to the next surface at which the index changes.

struct Flight {
    p_lc: vec3f,
    rest_lc: vec3f,             // what 32 bits leave out of it
    d_ws: vec3f,
    winding: Winding,
    departed: u32,              // the surface it has just left, or NO_ID
    inside: bool,               // and goes on inside of that surface's body
    known: bool,                // what it is inside of is known
    eye_t: f32,                 // where the eye is on its line, if it comes from there; else 0
}

const MEETS_NOTHING: u32 = 0u;
const MEETS_BOUNDARY: u32 = 1u;
const MEETS_OPAQUE: u32 = 2u;

struct Met {
    what: u32,
    hit: Hit,
    before: Winding,
    beyond: Winding,
    tint: vec3f,                // share of light that the media on the way let through
    path_m: f32,                // metres in bodies
    flags: u32,
}

const MOST_GROUPED: u32 = 4u;
// Crossings that a flight may pass: more than any line has; a bound all the same.
const MOST_PASSED: u32 = 65536u;

var<private> grouped: array<Hit, 4>;
var<private> grouped_count: u32;

fn begin_search(eye_t: f32) {
    after_t = select(eye_t, -blur_m(line, 0.0, 0.015625), eye_t == 0.0);
    after_id = NO_ID;
}

fn search() {
    search_low = select(after_t, -blur_m(line, 0.0, 0.0), summing);
    search_high = BEYOND;
    nearest = Hit(BEYOND, NO_ID, 0u, false, 1.0, vec2f(0.0));
    second_t = BEYOND;
    meet_triangles();
    meet_analytic();
}

fn pass_through(met: ptr<function, Met>, winding: Winding, length_m: f32) {
    let medium = medium_in(winding);
    if (medium != 0u) {
        let metres = max(length_m, 0.0);
        (*met).path_m += metres;
        (*met).tint *= transmitted(metres, body_of_medium(medium));
    }
}

fn follow(flight: Flight) -> Met {
    line = line_along(flight.p_lc, flight.d_ws);
    origin_rest_lc = flight.rest_lc;
    departed_id = flight.departed;
    departed_inside = flight.inside;
    from_eye = flight.eye_t < 0.0;
    settled = false;
    summing = !flight.known;
    far = NOWHERE;
    near_count = 0u;
    grouped_count = 0u;
    var winding = flight.winding;
    var met = Met(MEETS_NOTHING, nearest, winding, winding, vec3f(1.0), 0.0, 0u);
    var t = flight.eye_t;
    var fresh = true;
    begin_search(flight.eye_t);
    for (var passed = 0u; passed < MOST_PASSED; passed += 1u) {
        search();
        if (summing) {
            // Start again, with the crossings about the start told apart.
            summing = false;
            settled = true;
            winding = settled_start(flight.winding, flight.known);
            met = Met(MEETS_NOTHING, nearest, winding, winding, vec3f(1.0), 0.0, 0u);
            after_t = -blur_m(line, 0.0, 0.0);
            after_id = NO_ID;
            t = 0.0;
            grouped_count = 0u;
            continue;
        }
        let none = nearest.id == NO_ID;
        if (!settled && !from_eye && is_doubtful(winding, none, fresh)) {
            summing = true;
            continue;
        }
        if (grouped_count > 0u && (none || nearest.body >= OPAQUE || nearest.t > t + group_m())) {
            if (eta_of_medium(medium_in(met.before)) != eta_of_medium(medium_in(winding))) {
                met.what = MEETS_BOUNDARY;
                met.hit = decisive(medium_in(met.before), medium_in(winding));
                met.beyond = winding;
                return met;
            }
            // They change nothing together: what was found is looked at once more.
            grouped_count = 0u;
        }
        if (none) {
            pass_through(&met, winding, BEYOND);
            return met;
        }
        if (grouped_count == 0u) {
            pass_through(&met, winding, nearest.t - t);
            t = max(nearest.t, t);
            met.before = winding;
        }
        if (nearest.body >= OPAQUE) {
            met.what = MEETS_OPAQUE;
            met.hit = nearest;
            return met;
        }
        fresh = false;
        after_t = nearest.t;
        after_id = nearest.id;
        winding = crossed(winding, solid_of(nearest.body), nearest.entering);
        if (NESTED && (grouped_count > 0u || second_t <= nearest.t + grouped_m())) {
            grouped[min(grouped_count, MOST_GROUPED - 1u)] = nearest;
            grouped_count += 1u;
            continue;
        }
        if (eta_of_medium(medium_in(met.before)) != eta_of_medium(medium_in(winding))) {
            met.what = MEETS_BOUNDARY;
            met.hit = nearest;
            met.beyond = winding;
            return met;
        }
    }
    met.flags |= FLAG_CAP;
    return met;
}

// Rounding could make the closest crossing another one, or has done so.
fn is_doubtful(winding: Winding, none: bool, fresh: bool) -> bool {
    if (none) {
        return !is_outside(winding);
    }
    if (nearest.body >= OPAQUE) {
        return fresh && nearest.t <= blur_m(line, nearest.t, nearest.cosine);
    }
    let own = nearest.id >= FIRST_ANALYTIC && nearest.id == (departed_id | 1u) && departed_id != NO_ID;
    let at_start = fresh && !own && nearest.t <= blur_m(line, nearest.t, nearest.cosine);
    let from_nothing = !nearest.entering && count_of(winding, solid_of(nearest.body)) <= 0;
    return at_start || from_nothing;
}

// How far behind the first of a group its last may lie.
fn group_m() -> f32 {
    return blur_m(line, grouped[0].t, max(grouped[0].cosine, 0.0625));
}

// Of crossings that are one: the surface of the medium that begins there, else of the
// one that ends.
fn decisive(before: u32, beyond: u32) -> Hit {
    let count = min(grouped_count, MOST_GROUPED);
    for (var i = 0u; i < count; i += 1u) {
        if (solid_of(grouped[i].body) + 1u == beyond) {
            return grouped[i];
        }
    }
    for (var i = 0u; i < count; i += 1u) {
        if (solid_of(grouped[i].body) + 1u == before) {
            return grouped[i];
        }
    }
    return grouped[0];
}

fn spot_at(hit: Hit) -> Spot {
    if (hit.id >= FIRST_ANALYTIC) {
        return spot_on_analytic(hit);
    }
    return spot_on_triangle(hit);
}
