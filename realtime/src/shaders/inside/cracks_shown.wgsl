// needs: interior_lookup
// Cracks lie inside the body and add their glitter to what comes through it.
// The twin of cracks_none.wgsl.

@group(0) @binding(20) var cracks: texture_2d<f32>;

fn with_cracks(pixel: vec2i, beyond: vec3f) -> vec3f {
    return beyond + of_inside(cracks, pixel).rgb;
}
