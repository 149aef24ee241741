// What cracks and air inside a body are drawn with.

struct Interior {
    towards_light_ws: vec3f,
    size_m: f32,                // radius of the scene
}

@group(0) @binding(22) var<uniform> interior: Interior;
