// What a method says of a pixel. A method is a file with
//     fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace
// and what it reads is what will be drawn before it runs.

struct Trace {
    exit_ws: vec3f,             // unit direction in which the ray leaves
    first_ws: vec3f,            // unit direction after the first interface
    hit2_lc: vec3f,             // where it meets the second interface
    path_m: f32,                // metres inside
    events: u32,                // interfaces
    flags: u32,
}
