// needs: front
// Interpolated normals: the triangle's own is stored beside them.
// The twin of geometric_same.wgsl.

fn geometric_normal(pixel: vec2i, shading_ws: vec3f) -> vec3f {
    return normalize(textureLoad(front_geometric, pixel, 0).xyz);
}
