// Nobody asked for the direction in which the ray leaves. The twin of out_exit.wgsl.

fn put_exit(pixel: vec2i, value: vec4f) {
}
