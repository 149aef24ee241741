// needs: varyings camera
// Light from opaque surfaces: painted radiance, or Lambert's law under the
// scene's lights, which nothing blocks; the exact renderer's formula.

struct Paint {
    object_from_lc: mat4x4f,
    first: vec3f,
    size_m: f32,                // edge of a cube of the checker
    second: vec3f,
    lit: u32,                   // 0: the colour is radiance; 1: it is albedo
}

struct Light {
    place: vec4f,               // xyz position, local space, w = 1; or direction of travel, w = 0
    colour: vec3f,              // radiant intensity, or irradiance
}

struct Surroundings {
    paints: array<Paint, 16>,
    lights: array<Light, 16>,
    light_count: u32,
}

@group(0) @binding(17) var<uniform> surroundings: Surroundings;

fn irradiance(light: Light, p_lc: vec3f, n_ws: vec3f) -> vec3f {
    if (light.place.w == 0.0) {
        return light.colour * max(-dot(light.place.xyz, n_ws), 0.0);
    }
    let to = light.place.xyz - p_lc;
    let squared = dot(to, to);
    if (squared == 0.0) {
        return vec3f(0.0);
    }
    return light.colour * max(dot(to * inverseSqrt(squared), n_ws), 0.0) / squared;
}

fn opaque_light(v: Varyings) -> vec4f {
    let number = u32(v.body + 0.5) - 1u;
    return vec4f(light_of_surface(number, v.p_lc, normalize(v.normal_ws), direction_to_ws(v.p_lc)), 1.0);
}

// Towards a ray of direction d_ws that meets the surface.
fn light_of_surface(number: u32, p_lc: vec3f, outward_ws: vec3f, d_ws: vec3f) -> vec3f {
    let paint = surroundings.paints[number];
    let cell = floor((paint.object_from_lc * vec4f(p_lc, 1.0)).xyz / paint.size_m);
    let sum = cell.x + cell.y + cell.z;
    let colour = select(paint.first, paint.second, sum - 2.0 * floor(0.5 * sum) > 0.5);
    if (paint.lit == 0u) {
        return colour;
    }
    let n_ws = select(-outward_ws, outward_ws, dot(outward_ws, d_ws) < 0.0);
    var light = vec3f(0.0);
    for (var i = 0u; i < surroundings.light_count; i += 1u) {
        light += irradiance(surroundings.lights[i], p_lc, n_ws);
    }
    return colour * light / 3.14159265;
}
