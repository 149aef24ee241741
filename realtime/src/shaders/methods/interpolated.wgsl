// needs: front trace
// The vector was made at the vertices and interpolated without normalising, as
// the fixed pipeline did.

@group(0) @binding(9) var front_vector: texture_2d<f32>;

fn trace(pixel: vec2i, v_ws: vec3f, surface: Surface) -> Trace {
    let d_ws = normalize(textureLoad(front_vector, pixel, 0).xyz);
    return Trace(d_ws, d_ws, vec3f(0.0), 0.0, 1u, 0u);
}
