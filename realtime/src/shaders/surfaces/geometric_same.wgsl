// Flat or analytic normals: the shading normal is the geometric one.

fn geometric_normal(pixel: vec2i, shading_ws: vec3f) -> vec3f {
    return normalize(shading_ws);
}
