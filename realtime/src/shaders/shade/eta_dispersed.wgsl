// needs: frame
// An index for each of red, green and blue: `channel` says which is traced; that
// of green is the d line's.

var<private> channel: u32 = 1u;

fn eta_body(body: u32) -> f32 {
    return bodies[body].eta_channels[channel];
}
