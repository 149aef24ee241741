// needs: frame camera interface environment ray_flight ray_normals ray_opaque ray_chance
// needs: ray_fixed ray_spot ray_constants
// A path from the camera over its events: always through, mirrored only where nothing
// passes; or to one side of each boundary by chance, as often as light takes it.

struct Path {
    flight: Flight,
    light: vec3f,               // radiance that it brings
    tint: vec3f,
    first_ws: vec3f,            // unit direction after the first event
    hit2_lc: vec3f,             // where it meets its second surface
    path_m: f32,                // metres in bodies
    events: u32,
    flags: u32,
    met: bool,                  // it met a surface
    left: bool,                 // it ends in the environment
}

// A boundary and what it does to a ray.
struct Fork {
    hit: Hit,
    spot: Spot,
    before: Winding,
    beyond: Winding,
    d_ws: vec3f,                // of the ray that meets it
    eta_i: f32,
    eta_t: f32,
}

struct Sides {
    transmitted_ws: vec3f,
    reflected_ws: vec3f,
    share: f32,                 // that is reflected; 1 where nothing passes
    geometric: bool,            // the shading normal was replaced
}

// Total reflections in a row after which a path starts again with geometric normals:
// interpolated ones do not preserve phase space and may trap light for ever.
const PATIENCE: u32 = 64u;

fn sides_at(fork: Fork, outward_ws: vec3f) -> Sides {
    let n_ws = select(-outward_ws, outward_ws, fork.hit.entering);
    let bent = bend(fork.d_ws, n_ws, fork.eta_i / fork.eta_t);
    let share = select(fresnel_exact(fork.d_ws, n_ws, fork.eta_i, fork.eta_t), 1.0, bent.total);
    return Sides(bent.direction, normalize(reflect(fork.d_ws, n_ws)), share, false);
}

// If the shading normal does not face the ray, or sends light to the wrong side of the
// surface, the whole event happens at the geometric normal.
fn sides_of(fork: Fork, flat_only: bool) -> Sides {
    let outward = select(-1.0, 1.0, fork.hit.entering);
    let flat_ws = outward * fork.spot.geometric_ws;
    let apart = MAY_TRAP && any(fork.spot.normal_ws != fork.spot.geometric_ws);
    if (!apart || flat_only) {
        return sides_at(fork, fork.spot.geometric_ws);
    }
    let smooth_ws = outward * fork.spot.normal_ws;
    let sides = sides_at(fork, fork.spot.normal_ws);
    let sound = dot(fork.d_ws, smooth_ws) < 0.0 && dot(sides.reflected_ws, flat_ws) > 0.0
        && (sides.share >= 1.0 || dot(sides.transmitted_ws, flat_ws) < 0.0);
    if (sound) {
        return sides;
    }
    var replaced = sides_at(fork, fork.spot.geometric_ws);
    replaced.geometric = true;
    return replaced;
}

// True if there would be total reflection at the geometric normal.
fn is_total_if_flat(fork: Fork) -> bool {
    let cosine = dot(fork.d_ws, fork.spot.geometric_ws);
    let ratio = fork.eta_i / fork.eta_t;
    return ratio * ratio * (1.0 - cosine * cosine) >= 1.0;
}

fn begun(pixel: vec2i) -> Path {
    let at_px = pixel_centre_px(pixel);
    let d_ws = view_direction_ws(at_px);
    var flight = Flight(view_origin_lc(at_px), vec3f(0.0), d_ws, NOWHERE, NO_ID, false, false, 0.0);
    if (!RAY_STARTS_INSIDE) {
        let eye_t = min(-frame.waist_depth_m / dot(d_ws, frame.forward_ws), -1e-30);
        let waist = waist_of_pixel(pixel);
        flight = Flight(waist.p_lc, waist.rest_lc, d_ws, NOWHERE, NO_ID, false, true, eye_t);
    }
    return Path(flight, vec3f(0.0), vec3f(1.0), vec3f(0.0), vec3f(0.0), 0.0, 0u, 0u, false, false);
}

fn go_on(path: ptr<function, Path>, fork: Fork, sides: Sides, mirrored: bool) {
    let winding = select_winding(fork.beyond, fork.before, mirrored);
    let d_ws = select(sides.transmitted_ws, sides.reflected_ws, mirrored);
    let inside = fork.hit.entering != mirrored;
    (*path).flight = Flight(fork.spot.p_lc, fork.spot.rest_lc, d_ws, winding, fork.hit.id, inside, true, 0.0);
    (*path).flags |= select(0u, FLAG_GEOMETRIC_NORMAL, sides.geometric);
}

fn select_winding(otherwise: Winding, then: Winding, condition: bool) -> Winding {
    if (condition) {
        return then;
    }
    return otherwise;
}

// Follows a path to its end. `by_chance`: to either side of a boundary.
fn followed(pixel: vec2i, by_chance: bool) -> Path {
    var path = begun(pixel);
    // Where it starts again if interpolated normals trap it.
    var restart = path;
    var last: Fork;
    var last_mirrored = false;
    var in_a_row = 0u;
    var bent = false;
    var flat_only = !MAY_TRAP;
    loop {
        let met = follow(path.flight);
        path.tint *= met.tint;
        path.path_m += met.path_m;
        path.flags |= met.flags;
        if (met.what == MEETS_NOTHING) {
            path.left = true;
            path.light = path.tint * environment(path.flight.d_ws);
            break;
        }
        path.met = true;
        let spot = shaded(spot_at(met.hit), met.hit);
        if (met.what == MEETS_OPAQUE) {
            path.light = path.tint * opaque_met(met.hit, spot);
            break;
        }
        path.events += 1u;
        if (path.events > RAY_EVENTS) {
            path.flags |= FLAG_CAP | FLAG_LOST;
            break;
        }
        var fork = Fork(met.hit, spot, met.before, met.beyond, path.flight.d_ws,
            eta_of_medium(medium_in(met.before)), eta_of_medium(medium_in(met.beyond)));
        var sides = sides_of(fork, flat_only);
        let total = sides.share >= 1.0;
        var mirrored = total || (by_chance && next_chance() < sides.share);
        if (MAY_TRAP) {
            let apart = any(spot.normal_ws != spot.geometric_ws);
            in_a_row = select(0u, in_a_row + 1u, total);
            if (total || is_total_if_flat(fork)) {
                bent = bent || apart;
            } else if (!flat_only) {
                restart = path;
                last = fork;
                last_mirrored = mirrored;
                bent = apart;
            }
            if (!flat_only && bent && in_a_row >= PATIENCE) {
                flat_only = true;
                path = restart;
                path.flags |= FLAG_GEOMETRIC_NORMAL;
                fork = last;
                sides = sides_of(fork, true);
                mirrored = last_mirrored || sides.share >= 1.0;
            }
        }
        go_on(&path, fork, sides, mirrored);
        if (path.events == 1u) {
            path.first_ws = path.flight.d_ws;
        }
        if (path.events == 2u) {
            path.hit2_lc = path.flight.p_lc;
        }
    }
    return path;
}
