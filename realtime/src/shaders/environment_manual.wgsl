// The bordered cube, filtered by hand with the formula that the exact renderer
// uses on the same texels.

@group(0) @binding(2) var environment_faces: texture_2d_array<f32>;

struct OnCube {
    face: i32,
    at: vec2f,                  // [0, 1]², y downwards
}

fn on_cube(d_ws: vec3f) -> OnCube {
    let a = abs(d_ws);
    var face: i32;
    var uv: vec2f;
    var major: f32;
    if (a.x >= a.y && a.x >= a.z) {
        face = select(1, 0, d_ws.x >= 0.0);
        uv = vec2f(select(d_ws.z, -d_ws.z, d_ws.x >= 0.0), -d_ws.y);
        major = a.x;
    } else if (a.y >= a.z) {
        face = select(3, 2, d_ws.y >= 0.0);
        uv = vec2f(d_ws.x, select(-d_ws.z, d_ws.z, d_ws.y >= 0.0));
        major = a.y;
    } else {
        face = select(5, 4, d_ws.z >= 0.0);
        uv = vec2f(select(-d_ws.x, d_ws.x, d_ws.z >= 0.0), -d_ws.y);
        major = a.z;
    }
    return OnCube(face, 0.5 * (uv / major + 1.0));
}

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
