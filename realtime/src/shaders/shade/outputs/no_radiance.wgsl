// Nobody asked for radiance and coverage. The twin of out_radiance.wgsl.

fn put_radiance(pixel: vec2i, value: vec4f) {
}
