// An interface in 32 bits: outward normal as an octahedral map of 15 + 15 bits,
// whether it faces the camera.
// Cigolle et al., "A survey of efficient representations for independent unit
// vectors", JCGT 3(2), 2014. The twin of pack_nested.wgsl.

fn pack_interface(normal_ws: vec3f, faces_camera: bool, solid: u32) -> u32 {
    let n = normal_ws / (abs(normal_ws.x) + abs(normal_ws.y) + abs(normal_ws.z));
    let turned = (1.0 - abs(n.yx)) * select(vec2f(-1.0), vec2f(1.0), n.xy >= vec2f(0.0));
    let folded = select(turned, n.xy, n.z >= 0.0);
    let q = vec2u(vec2i(round(folded * 16383.0)) + 16384);
    return q.x | (q.y << 15u) | (select(0u, 1u, faces_camera) << 30u);
}

fn unpack_normal(packed: u32) -> vec3f {
    let q = vec2i(vec2u(extractBits(packed, 0u, 15u), extractBits(packed, 15u, 15u))) - 16384;
    let f = vec2f(q) / 16383.0;
    let z = 1.0 - abs(f.x) - abs(f.y);
    let turned = (1.0 - abs(f.yx)) * select(vec2f(-1.0), vec2f(1.0), f >= vec2f(0.0));
    return normalize(vec3f(select(turned, f, z >= 0.0), z));
}

fn unpack_faces_camera(packed: u32) -> bool {
    return extractBits(packed, 30u, 1u) == 1u;
}

fn unpack_solid(packed: u32) -> u32 {
    return 0u;
}
