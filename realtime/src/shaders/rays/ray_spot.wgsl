// A place on a surface.

struct Place {
    p_lc: vec3f,
    rest_lc: vec3f,             // what 32 bits of float leave out of it
}

struct Spot {
    p_lc: vec3f,
    rest_lc: vec3f,
    geometric_ws: vec3f,        // outward, the surface's own
    normal_ws: vec3f,           // outward, what light bends at
    weights: vec2f,             // of a triangle's second and third corner
}
