// needs: ray_crossings ray_spot
// Convex bodies without triangles, by formula. The twin of ray_analytic_none.wgsl.

struct RayAnalytic {
    object_from_lc: mat4x4f,
    lc_from_object: mat4x4f,
    size_m: vec4f,              // radius; half extents; radius and half height
    formula: u32,
    body: u32,
}

@group(0) @binding(31) var<storage, read> ray_analytic: array<RayAnalytic>;

const FIRST_ANALYTIC: u32 = 0x80000000u;
const SPHERE: u32 = 0u;
const BOX: u32 = 1u;
const CYLINDER: u32 = 2u;
const HALF_SPACE: u32 = 3u;

// Where a line passes a surface, object space.
struct Touch {
    t: f32,
    n: vec3f,                   // outward, of any length
    p: vec3f,
}

// The stretch of a line inside a convex body; none where the exit is not behind the entry.
struct Chord {
    entry: Touch,
    exit: Touch,
}

fn nothing_inside() -> Chord {
    return Chord(Touch(BEYOND, vec3f(1.0), vec3f(0.0)), Touch(-BEYOND, vec3f(1.0), vec3f(0.0)));
}

fn both(a: Chord, b: Chord) -> Chord {
    var inside = a;
    if (b.entry.t > a.entry.t) {
        inside.entry = b.entry;
    }
    if (b.exit.t < a.exit.t) {
        inside.exit = b.exit;
    }
    return inside;
}

// Between two planes across an axis.
fn between(o: vec3f, d: vec3f, axis: vec3f, low_m: f32, high_m: f32) -> Chord {
    let along = dot(d, axis);
    let at = dot(o, axis);
    let aside = vec3f(1.0) - axis;
    if (abs(along) < 1e-18) {
        if (at <= low_m || at >= high_m) {
            return nothing_inside();
        }
        return Chord(Touch(-BEYOND, axis, o), Touch(BEYOND, axis, o));
    }
    let t_low = clamp((low_m - at) / along, -BEYOND, BEYOND);
    let t_high = clamp((high_m - at) / along, -BEYOND, BEYOND);
    let low = Touch(t_low, -axis, (o + t_low * d) * aside + low_m * axis);
    let high = Touch(t_high, axis, (o + t_high * d) * aside + high_m * axis);
    if (along > 0.0) {
        return Chord(low, high);
    }
    return Chord(high, low);
}

// A ball, or an endless cylinder where the mask drops an axis.
fn around(o: vec3f, d: vec3f, mask: vec3f, radius_m: f32) -> Chord {
    let across = d * mask;
    let d_2 = dot(across, across);
    if (d_2 < 1e-36) {
        if (length(o * mask) >= radius_m) {
            return nothing_inside();
        }
        return Chord(Touch(-BEYOND, o * mask, o), Touch(BEYOND, o * mask, o));
    }
    // From the ray's nearest point to the axis: no difference of large squares.
    let middle = -dot(o, across) / d_2;
    let nearest_to = (o + middle * d) * mask;
    let off_m = length(nearest_to);
    let half_2 = (radius_m - off_m) * (radius_m + off_m) / d_2;
    if (half_2 <= 0.0) {
        return nothing_inside();
    }
    let reach = sqrt(half_2);
    return Chord(touch_of(o, d, mask, nearest_to, middle, -reach, radius_m),
        touch_of(o, d, mask, nearest_to, middle, reach, radius_m));
}

fn touch_of(o: vec3f, d: vec3f, mask: vec3f, nearest_to: vec3f, middle: f32, aside: f32, radius_m: f32) -> Touch {
    let n = normalize(nearest_to + aside * d * mask);
    let t = middle + aside;
    return Touch(t, n, n * radius_m + (o + t * d) * (vec3f(1.0) - mask));
}

fn chord_of(index: u32) -> Chord {
    let o = (ray_analytic[index].object_from_lc * vec4f(line.origin_lc, 1.0)).xyz;
    let d = (ray_analytic[index].object_from_lc * vec4f(line.d_ws, 0.0)).xyz;
    let size = ray_analytic[index].size_m.xyz;
    let up = vec3f(0.0, 1.0, 0.0);
    switch (ray_analytic[index].formula) {
        case SPHERE: {
            return around(o, d, vec3f(1.0), size.x);
        }
        case BOX: {
            let x = between(o, d, vec3f(1.0, 0.0, 0.0), -size.x, size.x);
            let y = between(o, d, up, -size.y, size.y);
            return both(both(x, y), between(o, d, vec3f(0.0, 0.0, 1.0), -size.z, size.z));
        }
        case CYLINDER: {
            return both(around(o, d, vec3f(1.0, 0.0, 1.0), size.x), between(o, d, up, -size.y, size.y));
        }
        default: {
            return between(o, d, up, -BEYOND, 0.0);
        }
    }
}

fn normal_from_object(index: u32, n: vec3f) -> vec3f {
    return normalize((transpose(ray_analytic[index].object_from_lc) * vec4f(n, 0.0)).xyz);
}

// A convex body that was left is not met again; one that was entered is left.
fn meet_analytic() {
    for (var index = 0u; index < arrayLength(&ray_analytic); index += 1u) {
        let id = FIRST_ANALYTIC + 2u * index;
        let own = departed_id != NO_ID && (departed_id & ~1u) == id;
        if (own && !departed_inside) {
            continue;
        }
        let chord = chord_of(index);
        if (chord.entry.t >= chord.exit.t) {
            continue;
        }
        let body = ray_analytic[index].body;
        let left = normal_from_object(index, chord.exit.n);
        let exit = Hit(chord.exit.t, id + 1u, body, false, abs(dot(left, line.d_ws)), vec2f(0.0));
        if (own) {
            consider(Hit(max(exit.t, 0.0), exit.id, body, false, exit.cosine, vec2f(0.0)), true);
            continue;
        }
        let entered = normal_from_object(index, chord.entry.n);
        consider(Hit(chord.entry.t, id, body, true, abs(dot(entered, line.d_ws)), vec2f(0.0)), false);
        consider(exit, false);
    }
}

fn spot_on_analytic(hit: Hit) -> Spot {
    let index = (hit.id - FIRST_ANALYTIC) >> 1u;
    let chord = chord_of(index);
    var touch = chord.entry;
    if (!hit.entering) {
        touch = chord.exit;
    }
    let n_ws = normal_from_object(index, touch.n);
    return Spot((ray_analytic[index].lc_from_object * vec4f(touch.p, 1.0)).xyz, vec3f(0.0), n_ws, n_ws, vec2f(0.0));
}
