// needs: camera varyings surface_normal pack
// What is kept of an interface besides its depth.

fn packed_interface(v: Varyings) -> u32 {
    let v_ws = view_direction_ws(v.clip.xy);
    let body = u32(v.body + 0.5) - 1u;
    return pack_interface(
        surface_normal_ws(v), dot(v_ws, v.geometric_ws) < 0.0, bodies[body].solid);
}
