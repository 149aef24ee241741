// A ray as a line whose direction is sheared onto an axis: a vertex has the same
// place beside it in every triangle that the vertex belongs to. Woop, Benthin & Wald,
// "Watertight ray/triangle intersection", JCGT 2(1), 2013.

struct Line {
    origin_lc: vec3f,
    d_ws: vec3f,                // unit
    inverse_d: vec3f,           // finite
    axis: u32,                  // along which the direction is longest
    shear: vec2f,
    inverse_z: f32,
    reach_m: f32,               // largest coordinate of the origin
}

// Share of a coordinate within which 32 bits cannot tell places apart: the products
// and sums of an intersection lose about eight units in the last place of it.
const ROUNDING: f32 = 9.5367431640625e-7;
// Cosine below which a surface does not blur more.
const FLATTEST: f32 = 9.765625e-4;

fn line_along(origin_lc: vec3f, d_ws: vec3f) -> Line {
    let size = abs(d_ws);
    var axis = 2u;
    if (size.x >= size.y && size.x >= size.z) {
        axis = 0u;
    } else if (size.y >= size.z) {
        axis = 1u;
    }
    let d = turned(d_ws, axis);
    let inverse_d = 1.0 / select(d_ws, select(vec3f(-1e-18), vec3f(1e-18), d_ws >= vec3f(0.0)), size < vec3f(1e-18));
    let reach = abs(origin_lc);
    return Line(origin_lc, d_ws, inverse_d, axis, d.xy / d.z, 1.0 / d.z, max(max(reach.x, reach.y), reach.z));
}

// Coordinates with an axis last, right-handed as before.
fn turned(v: vec3f, axis: u32) -> vec3f {
    return select(select(v.zxy, v.yzx, axis == 0u), v, axis == 2u);
}

// A vertex seen along a line: its place beside it, and t of the plane through it.
fn seen_along(line: Line, p_lc: vec3f) -> vec3f {
    let v = turned(p_lc - line.origin_lc, line.axis);
    return vec3f(fma(-line.shear, vec2f(v.z), v.xy), v.z * line.inverse_z);
}

// How far rounding can move a crossing along a line.
fn blur_m(line: Line, t: f32, cosine: f32) -> f32 {
    return ROUNDING * (line.reach_m + abs(t)) / max(cosine, FLATTEST);
}
