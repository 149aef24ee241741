// Nobody asked for interfaces, flags and metres inside. The twin of out_count.wgsl.

fn put_count(pixel: vec2i, value: vec4f) {
}
