// On which side of an edge a line passes, decided exactly: in floats where they
// suffice, else by the products' integers. A line through the edge itself counts as
// moved by (x, y), x much larger than y, both smaller than any number. So closed
// meshes have no gaps, whatever a compiler makes of the floats.
// Edelsbrunner & Mücke, "Simulation of simplicity", ACM TOG 9(1), 1990.

// a x b with a sign that is never wrong; zero only where a and b coincide.
fn edge_side(a: vec2f, b: vec2f) -> f32 {
    let p = a.x * b.y;
    let q = a.y * b.x;
    let d = p - q;
    if (abs(d) > 4.8e-7 * (abs(p) + abs(q))) {
        return d;
    }
    let sign_of_d = difference_sign(product_of(a.x, b.y), product_of(a.y, b.x));
    if (sign_of_d != 0) {
        return f32(sign_of_d) * max(abs(d), 1e-37);
    }
    let towards = select(a.y - b.y, b.x - a.x, a.y == b.y);
    return sign(towards) * 1e-37;
}

// The exact product of two floats: ±(high, low) 2^exponent. Subnormals are zero.
struct Product {
    sign_of: i32,
    exponent: i32,
    high: u32,
    low: u32,
}

fn product_of(x: f32, y: f32) -> Product {
    let bits = vec2u(bitcast<u32>(x), bitcast<u32>(y));
    let exponents = vec2i((bits >> vec2u(23u)) & vec2u(255u));
    if (any(exponents == vec2i(0))) {
        return Product(0, 0, 0u, 0u);
    }
    let m = (bits & vec2u(0x7fffffu)) | vec2u(0x800000u);
    let upper = m >> vec2u(16u);
    let lower = m & vec2u(0xffffu);
    let middle = upper.x * lower.y + upper.y * lower.x;
    let shifted = middle << 16u;
    let low = lower.x * lower.y + shifted;
    let carry = select(0u, 1u, low < shifted);
    let high = upper.x * upper.y + (middle >> 16u) + carry;
    let negative = ((bits.x ^ bits.y) >> 31u) == 1u;
    return Product(select(1, -1, negative), exponents.x + exponents.y, high, low);
}

fn difference_sign(p: Product, q: Product) -> i32 {
    if (p.sign_of != q.sign_of) {
        return select(-1, 1, p.sign_of > q.sign_of);
    }
    return p.sign_of * magnitude_sign(p, q);
}

fn magnitude_sign(p: Product, q: Product) -> i32 {
    let steps = p.exponent - q.exponent;
    if (abs(steps) > 2) {
        return sign(steps);
    }
    // At most 48 bits are used, so two more fit.
    let a = scaled_up(p, u32(max(steps, 0)));
    let b = scaled_up(q, u32(max(-steps, 0)));
    if (a.x != b.x) {
        return select(-1, 1, a.x > b.x);
    }
    return select(select(-1, 1, a.y > b.y), 0, a.y == b.y);
}

fn scaled_up(p: Product, steps: u32) -> vec2u {
    let spill = select(p.low >> (32u - max(steps, 1u)), 0u, steps == 0u);
    return vec2u((p.high << steps) | spill, p.low << steps);
}
