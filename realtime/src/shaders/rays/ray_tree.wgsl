// needs: ray_line ray_edge ray_crossings ray_spot ray_fixed ray_constants
// The triangles, under a compressed tree of eight children to a node. Ylitie, Karras &
// Laine, "Efficient incoherent ray traversal on GPUs through compressed wide BVHs",
// HPG 2017. The twin of ray_tree_none.wgsl.

// Five to a node: origin, exponents and which children are nodes; first child, first
// triangle, what each child is; the children's lower and upper bounds along x, y, z.
@group(0) @binding(29) var<storage, read> ray_nodes: array<vec4u>;
// Three to a triangle: the corners; w: x, y and z of its outward normal.
@group(0) @binding(30) var<storage, read> ray_triangles: array<vec4f>;
@group(0) @binding(39) var<storage, read> ray_bodies: array<u32>;

fn bytes_of(word: u32) -> vec4f {
    return vec4f((vec4u(word) >> vec4u(0u, 8u, 16u, 24u)) & vec4u(255u));
}

// Which of four children the line meets: bits of nodes from 24 upwards, by the order in
// which they are met, and of triangles below.
fn four_met(start: vec3f, step: vec3f, what: u32, low: vec3u, high: vec3u, octants: u32) -> u32 {
    let swapped = step < vec3f(0.0);
    let nearer = select(low, high, swapped);
    let farther = select(high, low, swapped);
    let near_x = bytes_of(nearer.x) * step.x + start.x;
    let near_y = bytes_of(nearer.y) * step.y + start.y;
    let near_z = bytes_of(nearer.z) * step.z + start.z;
    let far_x = bytes_of(farther.x) * step.x + start.x;
    let far_y = bytes_of(farther.y) * step.y + start.y;
    let far_z = bytes_of(farther.z) * step.z + start.z;
    let t_near = max(max(max(near_x, near_y), near_z), vec4f(search_low));
    let t_far = min(min(min(far_x, far_y), far_z), vec4f(search_high));
    let met = t_near <= t_far;
    let is_node = (((what & (what << 1u)) & 0x10101010u) >> 4u) * 0xffu;
    let places = (what ^ (octants & is_node)) & 0x1f1f1f1fu;
    let bits = (what >> 5u) & 0x07070707u;
    var mask = 0u;
    for (var child = 0u; child < 4u; child += 1u) {
        let own = extractBits(bits, 8u * child, 3u) << extractBits(places, 8u * child, 5u);
        mask |= select(0u, own, met[child]);
    }
    return mask;
}

fn children_met(node: u32, octants: u32) -> u32 {
    let head = ray_nodes[5u * node];
    let what = ray_nodes[5u * node + 1u].zw;
    let x = ray_nodes[5u * node + 2u];
    let y = ray_nodes[5u * node + 3u];
    let z = ray_nodes[5u * node + 4u];
    let exponents = (vec3u(head.w) >> vec3u(0u, 8u, 16u)) & vec3u(255u);
    let step = bitcast<vec3f>(exponents << vec3u(23u)) * line.inverse_d;
    let start = (bitcast<vec3f>(head.xyz) - line.origin_lc) * line.inverse_d;
    return four_met(start, step, what.x, vec3u(x.x, y.x, z.x), vec3u(x.z, y.z, z.z), octants)
        | four_met(start, step, what.y, vec3u(x.y, y.y, z.y), vec3u(x.w, y.w, z.w), octants);
}

fn meet_triangle(slot: u32) {
    let corner_a = ray_triangles[3u * slot];
    let corner_b = ray_triangles[3u * slot + 1u];
    let corner_c = ray_triangles[3u * slot + 2u];
    let a = seen_along(line, corner_a.xyz);
    let b = seen_along(line, corner_b.xyz);
    let c = seen_along(line, corner_c.xyz);
    let sides = vec3f(edge_side(b.xy, c.xy), edge_side(c.xy, a.xy), edge_side(a.xy, b.xy));
    if (any(sides <= vec3f(0.0)) && any(sides >= vec3f(0.0))) {
        return;
    }
    let area = sides.x + sides.y + sides.z;
    let weights = sides / area;
    let t = dot(weights, vec3f(a.z, b.z, c.z));
    let across = cross(corner_b.xyz - corner_a.xyz, corner_c.xyz - corner_a.xyz);
    let cosine = min(abs(area / line.inverse_z) / max(length(across), 1e-37), 1.0);
    let entering = (area < 0.0) == (line.inverse_z > 0.0);
    consider(Hit(t, slot, ray_bodies[slot], entering, cosine, weights.yz), false);
}

fn meet_triangles() {
    let octants = select(0x04040404u, 0u, line.d_ws.x < 0.0)
        | select(0x02020202u, 0u, line.d_ws.y < 0.0)
        | select(0x01010101u, 0u, line.d_ws.z < 0.0);
    var stack: array<vec2u, RAY_STACK>;
    var depth = 0u;
    var group = vec2u(0u, 0x80000000u);
    loop {
        if ((group.y & 0xff000000u) == 0u) {
            if (depth == 0u) {
                break;
            }
            depth -= 1u;
            group = stack[depth];
        }
        let bit = firstLeadingBit(group.y);
        let slot = (bit - 24u) ^ (octants & 7u);
        let node = group.x + countOneBits(group.y & ~(0xffffffffu << slot));
        group.y &= ~(1u << bit);
        if ((group.y & 0xff000000u) != 0u) {
            stack[depth] = group;
            depth += 1u;
        }
        let met = children_met(node, octants);
        let first = ray_nodes[5u * node + 1u].xy;
        group = vec2u(first.x, (met & 0xff000000u) | (ray_nodes[5u * node].w >> 24u));
        var triangles = met & 0x00ffffffu;
        while (triangles != 0u) {
            let triangle = firstLeadingBit(triangles);
            triangles &= ~(1u << triangle);
            // What a ray has left it does not meet at once again.
            if (first.y + triangle != departed_id) {
                meet_triangle(first.y + triangle);
            }
        }
    }
}

// Position and outward normal of a triangle where it was hit. The place beside the first
// corner is the difference of numbers far larger than it: in fixed places it keeps its digits.
fn spot_on_triangle(hit: Hit) -> Spot {
    let a = ray_triangles[3u * hit.id];
    let b = ray_triangles[3u * hit.id + 1u];
    let c = ray_triangles[3u * hit.id + 2u];
    let n_ws = vec3f(a.w, b.w, c.w);
    let e_1 = b.xyz - a.xyz;
    let e_2 = c.xyz - a.xyz;
    if (!is_fixed(line.origin_lc)) {
        let p_lc = a.xyz + hit.weights.x * e_1 + hit.weights.y * e_2;
        return Spot(p_lc, vec3f(0.0), n_ws, n_ws, hit.weights);
    }
    let origin = fixed(line.origin_lc) + fixed(origin_rest_lc);
    let corner = fixed(a.xyz);
    var q = vec3f(place_along(origin, line.d_ws, hit.t) - corner) * frame.unit_m;
    let across = cross(e_1, e_2);
    q -= line.d_ws * (dot(q, across) / dot(line.d_ws, across));
    let weights = vec2f(dot(cross(q, e_2), across), dot(cross(e_1, q), across)) / dot(across, across);
    let beside = weights.x * e_1 + weights.y * e_2;
    let p_lc = a.xyz + beside;
    return Spot(p_lc, left_out(corner + fixed(beside), p_lc), n_ws, n_ws, weights);
}
