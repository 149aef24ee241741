// needs: frame camera varyings vertex_vector targets
// Draws triangles. What is written is the pass's own: targets().

struct Corner {
    @location(0) p_lc: vec3f,
    @location(1) normal_ws: vec3f,
    @location(2) geometric_ws: vec3f,
    @location(3) thickness_m: f32,
    @location(4) body: f32,     // number, 1 for the first
}

@vertex
fn mesh_vertex(corner: Corner) -> Varyings {
    let clip = frame.clip_from_lc * vec4f(corner.p_lc, 1.0);
    let vector_ws = vertex_vector(direction_to_ws(corner.p_lc), corner.normal_ws, u32(corner.body + 0.5) - 1u);
    return Varyings(clip, corner.p_lc, corner.normal_ws, corner.geometric_ws, corner.body,
        corner.thickness_m, vector_ws);
}

@fragment
fn mesh_fragment(v: Varyings) -> Targets {
    return targets(v);
}
