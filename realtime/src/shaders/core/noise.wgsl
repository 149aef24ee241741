// Gradient noise, the same as the exact renderer's: integer hashes, and gradients
// that 32 bits hold exactly.

fn scramble(bits: u32) -> u32 {
    var x = bits ^ (bits >> 16u);
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    return x ^ (x >> 16u);
}

fn lattice_hash(cell: vec3i, seed: u32) -> u32 {
    var hash = seed;
    for (var axis = 0; axis < 3; axis += 1) {
        hash = scramble((hash + 0x9e3779b9u) ^ u32(cell[axis]));
    }
    return hash;
}

// Derivative of gradient noise with a lattice of unit cells.
fn noise_gradient(p: vec3f, seed: u32) -> vec3f {
    let low = floor(p);
    let f = p - low;
    let blend = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let slope = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    var sum = vec3f(0.0);
    for (var corner = 0u; corner < 8u; corner += 1u) {
        let bits = vec3u(corner & 1u, (corner >> 1u) & 1u, corner >> 2u);
        let at = vec3f(bits);
        let hash = lattice_hash(vec3i(low) + vec3i(bits), seed);
        let g = (vec3f(vec3u(hash, hash >> 8u, hash >> 16u) & vec3u(255u)) - 127.5) / 128.0;
        let w = mix(1.0 - blend, blend, at);
        let dw = (2.0 * at - 1.0) * slope;
        let ramp = dot(g, f - at);
        sum += w.x * w.y * w.z * g
            + ramp * vec3f(dw.x * w.y * w.z, w.x * dw.y * w.z, w.x * w.y * dw.z);
    }
    return sum;
}

// Of three octaves, each twice as fine and half as strong as the one before.
fn fbm_gradient(p: vec3f, seed: u32) -> vec3f {
    return (noise_gradient(p, scramble(seed)) + noise_gradient(2.0 * p, scramble(seed + 1u))
        + noise_gradient(4.0 * p, scramble(seed + 2u))) / 1.75;
}
