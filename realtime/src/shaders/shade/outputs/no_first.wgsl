// Nobody asked for the direction after the first interface. The twin of out_first.wgsl.

fn put_first(pixel: vec2i, value: vec4f) {
}
