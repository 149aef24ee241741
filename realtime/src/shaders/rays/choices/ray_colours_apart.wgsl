// needs: eta_dispersed
// Red, green and blue take ways of their own. The twin of ray_colours_together.wgsl.

fn choose_channel(number: u32) {
    channel = number;
}
