// needs: frame eta layers
// Several solids in the view: each layer says whose boundary it is, each solid
// counts its own winding, and where solids overlap the one with the highest
// priority fills the space. Schmidt & Budge, "Simple nested dielectrics in ray
// traced images", Journal of Graphics Tools 7(2), 2002.
// Solids are numbered by falling priority, 1 to 8; 0 is the surroundings.

const MEDIUM_SURROUNDINGS: u32 = 0u;

// Eight windings of four bits, each stored with 8 added.
fn medium_behind(pixel: vec2i, k: u32) -> u32 {
    var counts = 0x88888888u;
    for (var j = 0u; j < k; j += 1u) {
        let shift = 4u * layer_solid(pixel, j);
        counts = select(counts - (1u << shift), counts + (1u << shift), layer_faces_camera(pixel, j));
    }
    for (var solid = 0u; solid < 8u; solid += 1u) {
        if (extractBits(counts, 4u * solid, 4u) > 8u) {
            return solid + 1u;
        }
    }
    return MEDIUM_SURROUNDINGS;
}

fn eta_of(medium: u32) -> f32 {
    if (medium == MEDIUM_SURROUNDINGS) {
        return frame.eta_outside;
    }
    for (var body = 0u; body < 16u; body += 1u) {
        if (bodies[body].solid + 1u == medium) {
            return eta_body(body);
        }
    }
    return frame.eta_outside;
}

// The boundary that was crossed belongs to the solid of higher priority, which
// has the smaller number; the surroundings own no boundary.
fn enters(medium_i: u32, medium_t: u32) -> bool {
    return medium_t != 0u && (medium_i == 0u || medium_t < medium_i);
}

fn first_medium(body: u32) -> u32 {
    return bodies[body].solid + 1u;
}
