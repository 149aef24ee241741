// needs: varyings stored_interface
// What is found goes to memory of its own; a raster pass must have a target.

struct Targets {
    @location(0) nothing: vec4f,
}

fn targets(v: Varyings) -> Targets {
    return Targets(store_interface(v));
}
