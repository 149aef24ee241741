//! Seeded gradient noise and its gradient, made so that a GPU in f32 finds the
//! same lattice values: 32-bit integer hashes, and gradients with components in
//! steps of 1/128 that f32 holds exactly.
//!
//! Noise at `p`: corner gradients of the unit cell around `p` (components
//! (byte - 127.5)/128 of the corner's hash), each multiplied by the offset from
//! its corner, blended with 6t⁵ - 15t⁴ + 10t³ along each axis.
//! Source of the blend: Perlin, "Improving Noise", SIGGRAPH 2002.

use glam::DVec3;

/// A number and how fast it changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Between about -1 and 1, mean 0.
    pub value: f64,
    /// Derivative with respect to the position.
    pub gradient: DVec3,
}

/// Scrambles 32 bits; a bijection.
///
/// Source of the constants: Wellons, "Prospecting for Hash Functions", 2018
/// (lowbias32).
#[must_use]
pub fn scramble(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Folds a 64-bit seed into the 32 bits that the lattice hash takes.
#[must_use]
pub fn seed32(seed: u64) -> u32 {
    let low = u32::try_from(seed & 0xffff_ffff).unwrap_or(0);
    let high = u32::try_from(seed >> 32).unwrap_or(0);
    scramble(low ^ scramble(high ^ 0x9e37_79b9))
}

/// Hash of a lattice point.
#[must_use]
pub fn lattice_hash(cell: [i32; 3], seed: u32) -> u32 {
    cell.iter().fold(seed, |hash, x| scramble(hash.wrapping_add(0x9e37_79b9) ^ x.cast_unsigned()))
}

/// Gradient noise with a lattice of unit cells.
#[must_use]
pub fn gradient_noise(p: DVec3, seed: u32) -> Noise {
    let cell = p.floor();
    let f = p - cell;
    // Saturates beyond ±2^31 cells, where f64 noise is meaningless anyway.
    let origin = cell.to_array().map(|x| x as i32);
    let blend = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let slope = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    let mut sum = Noise::default();
    for corner in 0..8u32 {
        let bits = [corner & 1, (corner >> 1) & 1, corner >> 2];
        let at = DVec3::from_array(bits.map(f64::from));
        let hash =
            lattice_hash([0, 1, 2].map(|i| origin[i].wrapping_add(bits[i].cast_signed())), seed);
        let g = DVec3::from_array(
            [0, 8, 16].map(|shift| (f64::from((hash >> shift) & 255) - 127.5) / 128.0),
        );
        // Along each axis the weight is `blend` at 1 and 1 - `blend` at 0.
        let w = (1.0 - at) * (1.0 - blend) + at * blend;
        let dw = (2.0 * at - 1.0) * slope;
        let ramp = g.dot(f - at);
        sum.value += w.x * w.y * w.z * ramp;
        sum.gradient += w.x * w.y * w.z * g
            + ramp * DVec3::new(dw.x * w.y * w.z, w.x * dw.y * w.z, w.x * w.y * dw.z);
    }
    sum
}

/// Fractional Brownian motion: octaves of noise, each of twice the frequency
/// and half the weight of the one before, weights summing to 1.
#[must_use]
pub fn fbm(p: DVec3, octaves: u32, seed: u64) -> Noise {
    let seed = seed32(seed);
    let total = 2.0 - 0.5f64.powi(octaves.max(1).cast_signed() - 1);
    let mut sum = Noise::default();
    let (mut scale, mut weight) = (1.0, 1.0 / total);
    for octave in 0..octaves {
        let one = gradient_noise(p * scale, scramble(seed.wrapping_add(octave)));
        sum.value += weight * one.value;
        sum.gradient += weight * scale * one.gradient;
        scale *= 2.0;
        weight *= 0.5;
    }
    sum
}

/// SplitMix64: the sequence of 64-bit numbers behind every seeded pose.
///
/// Source: Steele, Lea & Flood, "Fast Splittable Pseudorandom Number
/// Generators", OOPSLA 2014.
#[derive(Clone, Copy, Debug)]
pub struct SplitMix64(pub u64);

impl SplitMix64 {
    /// Next 64 bits.
    pub fn next_bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1), in steps of 2^-53.
    pub fn uniform(&mut self) -> f64 {
        (self.next_bits() >> 11) as f64 * (0.5f64).powi(53)
    }

    /// Standard normal deviate (Box & Muller, 1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}
