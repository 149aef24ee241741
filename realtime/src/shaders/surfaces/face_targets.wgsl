// needs: varyings opaque
// What stands around the bodies, as a face of the cube sees it.

struct Targets {
    @location(0) face_light: vec4f,
}

fn targets(v: Varyings) -> Targets {
    return Targets(
        opaque_light(v),
    );
}
