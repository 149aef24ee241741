// needs: frame eta
// How often each solid surrounds a place, eight bits each with 128 added. Where solids
// overlap the one with the highest priority, which has the smallest number, fills the
// place. Schmidt & Budge, "Simple nested dielectrics in ray traced images", Journal of
// Graphics Tools 7(2), 2002. The twin of winding_single.wgsl.

struct Winding {
    counts: vec4u,
}

const NESTED: bool = true;
const SOLIDS: u32 = 16u;
const NOWHERE: Winding = Winding(vec4u(0x80808080u));

fn solid_of(body: u32) -> u32 {
    return bodies[body].solid;
}

fn crossed(winding: Winding, solid: u32, entering: bool) -> Winding {
    return with_count(winding, solid, count_of(winding, solid) + select(-1, 1, entering));
}

fn count_of(winding: Winding, solid: u32) -> i32 {
    var counts = winding.counts;
    return i32(extractBits(counts[solid >> 2u], 8u * (solid & 3u), 8u)) - 128;
}

fn with_count(winding: Winding, solid: u32, count: i32) -> Winding {
    var counts = winding.counts;
    let stored = u32(clamp(count, -128, 127) + 128);
    counts[solid >> 2u] = insertBits(counts[solid >> 2u], stored, 8u * (solid & 3u), 8u);
    return Winding(counts);
}

fn is_outside(winding: Winding) -> bool {
    return all(winding.counts == vec4u(0x80808080u));
}

fn medium_in(winding: Winding) -> u32 {
    for (var solid = 0u; solid < SOLIDS; solid += 1u) {
        if (count_of(winding, solid) > 0) {
            return solid + 1u;
        }
    }
    return 0u;
}

fn body_of_medium(medium: u32) -> u32 {
    for (var body = 0u; body < 16u; body += 1u) {
        if (bodies[body].solid + 1u == medium) {
            return body;
        }
    }
    return 0u;
}

fn eta_of_medium(medium: u32) -> f32 {
    if (medium == 0u) {
        return frame.eta_outside;
    }
    return eta_body(body_of_medium(medium));
}
