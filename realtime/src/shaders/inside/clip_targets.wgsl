// needs: frame varyings depth_format
// One end of the depth interval that holds a body, as it is stored.

struct Targets {
    @location(0) clip_depth: f32,
}

fn targets(v: Varyings) -> Targets {
    return Targets(
        stored_depth_m(depth_of_m(v.p_lc)),
    );
}
