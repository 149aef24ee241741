// needs: varyings clip noise
// Enclosed air: a plane through the middle, dense towards the core, with blobs of
// noise and small round bubbles. Premultiplied white.

fn air_light(v: Varyings) -> vec4f {
    if (!is_inside(v)) {
        discard;
    }
    let at = 2.0 * v.normal_ws.xy;
    let core = max(1.0 - length(at), 0.0);
    let cloud = clamp(length(fbm_gradient(vec3f(6.0 * at, 0.5), 11u)) - 0.35, 0.0, 1.0);
    // One disc in each cell of a grid, at a place and of a size of its own.
    let cell = floor(24.0 * at);
    let place = noise_gradient(vec3f(cell, 0.25), 23u);
    let centre = cell + 0.5 + 0.3 * place.xy;
    let radius = 0.18 * max(place.z, 0.0);
    let disc = 1.0 - smoothstep(0.7 * radius, radius + 1e-3, length(24.0 * at - centre));
    let alpha = clamp(core * core * (0.10 * cloud + 0.6 * disc), 0.0, 1.0);
    return vec4f(alpha);
}

struct Targets {
    @location(0) air: vec4f,
}

fn targets(v: Varyings) -> Targets {
    return Targets(air_light(v));
}
