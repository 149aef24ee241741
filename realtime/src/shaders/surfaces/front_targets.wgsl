// needs: frame varyings surface_normal
// What the front pass writes of the surface a pixel sees.

struct Targets {
    @location(0) front_normal: vec4f,
    @location(1) front_depth: f32,
    @location(2) front_geometric: vec4f,
    @location(3) front_vector: vec4f,
    @location(4) front_thickness: f32,
}

fn targets(v: Varyings) -> Targets {
    return Targets(
        vec4f(surface_normal_ws(v), v.body),
        depth_of_m(v.p_lc),
        vec4f(v.geometric_ws, 1.0),
        v.vector_ws,
        v.thickness_m,
    );
}
