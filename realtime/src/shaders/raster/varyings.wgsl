// What the pixels of a surface know of it.

struct Varyings {
    @builtin(position) @invariant clip: vec4f,      // in a fragment, xy: pixel position
    @location(0) p_lc: vec3f,
    @location(1) normal_ws: vec3f,
    @location(2) @interpolate(flat) geometric_ws: vec3f,
    @location(3) @interpolate(flat) body: f32,
    @location(4) thickness_m: f32,
    @location(5) vector_ws: vec4f,
}
