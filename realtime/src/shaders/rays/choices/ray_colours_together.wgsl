// Light of all colours takes one way. The twin of ray_colours_apart.wgsl.

fn choose_channel(number: u32) {}
