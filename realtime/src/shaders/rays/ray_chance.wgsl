// needs: noise frame
// Random numbers: a counter for each sample of each position in each pixel, hashed. O'Neill, "PCG: a
// family of simple fast space-efficient statistically good algorithms", 2014.

var<private> chance_state: u32;

fn begin_chance(pixel: vec2i, sample_number: u32, seed: u32) {
    let position = bitcast<u32>(frame.shift_px.x) ^ scramble(bitcast<u32>(frame.shift_px.y));
    let place = position ^ scramble(scramble(u32(pixel.x) ^ 0x9e3779b9u) + u32(pixel.y));
    chance_state = scramble(scramble(place + sample_number) ^ scramble(seed ^ 0x85ebca6bu));
}

// From 0 up to but not including 1.
fn next_chance() -> f32 {
    chance_state = chance_state * 747796405u + 2891336453u;
    let word = ((chance_state >> ((chance_state >> 28u) + 4u)) ^ chance_state) * 277803737u;
    return f32(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}
