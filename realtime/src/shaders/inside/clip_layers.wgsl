// needs: frame varyings layers
// A point is inside the body if more of the surfaces in front of it face the eye
// than turn away: exact for any closed body, to the precision of the layers.
// An extension of ours.

fn is_inside(v: Varyings) -> bool {
    let pixel = vec2i(v.clip.xy);
    let before = layers_before(pixel, depth_of_m(v.p_lc));
    var winding = 0;
    for (var k = 0u; k < before; k += 1u) {
        winding += select(-1, 1, layer_faces_camera(pixel, k));
    }
    return winding > 0;
}
