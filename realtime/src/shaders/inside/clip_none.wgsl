// needs: varyings
// Nothing is clipped: the sheets end where they should by themselves, or leave
// the body visibly. The twin of clip_depth.wgsl and clip_layers.wgsl.

fn is_inside(v: Varyings) -> bool {
    return true;
}
