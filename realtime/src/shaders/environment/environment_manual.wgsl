// needs: cube
// The bordered cube, filtered by hand with the formula that the exact renderer
// uses on the same texels.

@group(0) @binding(2) var environment_faces: texture_2d_array<f32>;

fn environment(d_ws: vec3f) -> vec3f {
    let size = f32(textureDimensions(environment_faces).x - 2u);
    let place = on_cube(d_ws);
    let position = clamp(place.at * size + 0.5, vec2f(0.5), vec2f(size + 0.5));
    let low = floor(position);
    let f = position - low;
    let i = vec2i(low);
    let top = mix(face_texel(i, place.face), face_texel(i + vec2i(1, 0), place.face), f.x);
    let bottom = mix(face_texel(i + vec2i(0, 1), place.face), face_texel(i + vec2i(1, 1), place.face), f.x);
    return mix(top, bottom, f.y);
}

fn face_texel(at: vec2i, face: i32) -> vec3f {
    return textureLoad(environment_faces, at, face, 0).rgb;
}
