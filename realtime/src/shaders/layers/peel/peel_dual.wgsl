// needs: frame varyings peel_packed
// The nearest and the farthest layer in one pass, both by blending to the
// larger: of depths between the two that were found last, and, at those two,
// of the halves of the packed normals. Interfaces at the very same depth are one,
// with a normal that mixes theirs.
// Bavoil & Myers, "Order independent transparency with dual depth peeling",
// NVIDIA, 2008.

// Bits of the depths that were found last; 0: none yet. What is found next lies
// strictly between them.
@group(0) @binding(26) var<storage, read> dual_bounds: array<vec2u>;

// Positive floats sort like their bits, and backwards like these.
const REVERSED: u32 = 0x7f000000u;

fn bounds_of(v: Varyings) -> vec2u {
    let pixel = vec2u(v.clip.xy);
    return dual_bounds[pixel.y * u32(frame.resolution_px.x) + pixel.x];
}

// x grows towards the eye, y away from it.
fn dual_extremes(v: Varyings) -> vec2f {
    let bounds = bounds_of(v);
    let depth = bitcast<u32>(depth_of_m(v.p_lc));
    if (bounds.x != 0u && (depth <= bounds.x || depth >= bounds.y)) {
        return vec2f(0.0);
    }
    return vec2f(bitcast<f32>(REVERSED - depth), bitcast<f32>(depth));
}

// Halves of 16 bits are exact as floats. 0: nothing was drawn.
fn dual_normals(v: Varyings) -> vec4f {
    let bounds = bounds_of(v);
    let depth = bitcast<u32>(depth_of_m(v.p_lc));
    let packed = packed_interface(v);
    let halves = vec2f(vec2u(packed & 0xffffu, packed >> 16u)) + 1.0;
    return vec4f(select(vec2f(0.0), halves, depth == bounds.x),
        select(vec2f(0.0), halves, depth == bounds.y));
}

struct Targets {
    @location(0) extremes: vec2f,
    @location(1) normals: vec4f,
}

fn targets(v: Varyings) -> Targets {
    return Targets(dual_extremes(v), dual_normals(v));
}
