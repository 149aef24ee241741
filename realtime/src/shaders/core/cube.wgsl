// Directions on the faces of a cube, as WebGPU numbers and turns them.

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
