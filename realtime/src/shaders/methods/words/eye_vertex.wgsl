// needs: front
// at vertices: vertex_eye
// Viewing direction and reflected share as the vertices knew them, interpolated:
// what the method's authors did.

@group(0) @binding(9) var front_vector: texture_2d<f32>;     // xyz viewing direction, w: share

fn eye_vector(pixel: vec2i, v_ws: vec3f) -> vec3f {
    return normalize(textureLoad(front_vector, pixel, 0).xyz);
}

fn share_at_surface(v_ws: vec3f, surface: Surface) -> f32 {
    return textureLoad(front_vector, surface.pixel, 0).w;
}
