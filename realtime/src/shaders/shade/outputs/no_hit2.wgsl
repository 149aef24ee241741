// Nobody asked for where the ray meets the second interface. The twin of out_hit2.wgsl.

fn put_hit2(pixel: vec2i, value: vec4f) {
}
