// needs: frame eta
// How often one kind of solid surrounds a place. The twin of winding_nested.wgsl.

struct Winding {
    count: i32,
}

const NESTED: bool = false;
const SOLIDS: u32 = 1u;
const NOWHERE: Winding = Winding(0);

fn solid_of(body: u32) -> u32 {
    return 0u;
}

fn crossed(winding: Winding, solid: u32, entering: bool) -> Winding {
    return Winding(winding.count + select(-1, 1, entering));
}

fn count_of(winding: Winding, solid: u32) -> i32 {
    return winding.count;
}

fn with_count(winding: Winding, solid: u32, count: i32) -> Winding {
    return Winding(count);
}

fn is_outside(winding: Winding) -> bool {
    return winding.count == 0;
}

// Number of what fills a place, from 1; 0 is the surroundings.
fn medium_in(winding: Winding) -> u32 {
    return select(0u, 1u, winding.count > 0);
}

// A body that is made of it.
fn body_of_medium(medium: u32) -> u32 {
    return 0u;
}

fn eta_of_medium(medium: u32) -> f32 {
    return select(frame.eta_outside, eta_body(0u), medium == 1u);
}
