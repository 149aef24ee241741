// An interface in 32 bits: outward normal as an octahedral map of 13 + 13 bits,
// whether it faces the camera, and whose boundary it is (0 to 15).
// Cigolle et al., "A survey of efficient representations for independent unit
// vectors", JCGT 3(2), 2014. The twin of pack_single.wgsl.

fn pack_interface(normal_ws: vec3f, faces_camera: bool, solid: u32) -> u32 {
    let n = normal_ws / (abs(normal_ws.x) + abs(normal_ws.y) + abs(normal_ws.z));
    let turned = (1.0 - abs(n.yx)) * select(vec2f(-1.0), vec2f(1.0), n.xy >= vec2f(0.0));
    let folded = select(turned, n.xy, n.z >= 0.0);
    let q = vec2u(vec2i(round(folded * 4095.0)) + 4096);
    return q.x | (q.y << 13u) | (select(0u, 1u, faces_camera) << 26u) | (solid << 27u);
}

fn unpack_normal(packed: u32) -> vec3f {
    let q = vec2i(vec2u(extractBits(packed, 0u, 13u), extractBits(packed, 13u, 13u))) - 4096;
    let f = vec2f(q) / 4095.0;
    let z = 1.0 - abs(f.x) - abs(f.y);
    let turned = (1.0 - abs(f.yx)) * select(vec2f(-1.0), vec2f(1.0), f >= vec2f(0.0));
    return normalize(vec3f(select(turned, f, z >= 0.0), z));
}

fn unpack_faces_camera(packed: u32) -> bool {
    return extractBits(packed, 26u, 1u) == 1u;
}

fn unpack_solid(packed: u32) -> u32 {
    return extractBits(packed, 27u, 4u);
}
