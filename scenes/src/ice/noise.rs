//! Seeded gradient noise and its gradient, made so that a GPU in f32 finds the
//! same lattice values: 32-bit integer hashes, and gradients with components in
//! steps of 1/128 that f32 holds exactly.
//!
//! Noise at `p`: corner gradients of the unit cell around `p` (components
//! (byte - 127.5)/128 of the corner's hash), each multiplied by the offset from
//! its corner, blended with 6t⁵ - 15t⁴ + 10t³ along each axis.
//! Source of the blend: Perlin, "Improving Noise", SIGGRAPH 2002.

use crate::scene::Bump;
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

/// Octaves of a bump map.
pub const BUMP_OCTAVES: u32 = 3;

/// The normal of a bump-mapped surface: the surface's own, tilted against the
/// slope of the noise.
///
/// n' = normalize(n - amplitude (g - (g · n) n)), with g the gradient of
/// [`fbm`] of 3 octaves at `position_os` · frequency, with respect to that
/// scaled position. Both vectors in object space, `normal_os` of unit length.
#[must_use]
pub fn bumped(normal_os: DVec3, position_os: DVec3, bump: &Bump) -> DVec3 {
    let slope = fbm(position_os * bump.frequency_per_m, BUMP_OCTAVES, bump.seed).gradient;
    (normal_os - bump.amplitude * slope.reject_from_normalized(normal_os)).normalize()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]
    use super::*;

    fn points() -> impl Iterator<Item = DVec3> {
        let mut random = SplitMix64(7);
        std::iter::repeat_with(move || {
            DVec3::from_array([0; 3].map(|_| 20.0 * random.uniform() - 10.0))
        })
        .take(2_000)
    }

    #[test]
    fn the_gradient_is_the_derivative() {
        for p in points() {
            let noise = fbm(p, 3, 5);
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let step = 1e-5 * axis;
                let difference = (fbm(p + step, 3, 5).value - fbm(p - step, 3, 5).value) / 2e-5;
                assert!((difference - noise.gradient.dot(axis)).abs() < 1e-6, "{p}");
            }
        }
    }

    /// The lattice is where gradient noise vanishes, and its gradient there is
    /// the corner's own: exact numbers that f32 holds.
    #[test]
    fn the_lattice_is_exact_in_single_precision() {
        for p in points().map(DVec3::round) {
            let noise = gradient_noise(p, 3);
            assert_eq!(noise.value, 0.0);
            let single = noise.gradient.as_vec3().as_dvec3();
            assert_eq!(single, noise.gradient);
            assert!(noise.gradient.abs().max_element() < 1.0);
        }
    }

    #[test]
    fn noise_is_centred_bounded_and_different_for_each_seed() {
        let (mut sum, mut square, mut product) = (0.0, 0.0, 0.0);
        for p in points() {
            let [one, other] = [1, 2].map(|seed| fbm(p, 4, seed).value);
            assert!(one.abs() < 1.0);
            sum += one;
            square += one * one;
            product += one * other;
        }
        assert!((sum / 2_000.0).abs() < 0.02);
        assert!((product / square).abs() < 0.1);
        assert!(square / 2_000.0 > 0.01);
    }

    /// First outputs for seed 1234567, as published with the reference code.
    #[test]
    fn splitmix_gives_the_published_sequence() {
        let mut random = SplitMix64(1_234_567);
        let first: Vec<u64> = (0..3).map(|_| random.next_bits()).collect();
        assert_eq!(
            first,
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]
        );
    }

    #[test]
    fn normal_deviates_have_unit_variance() {
        let mut random = SplitMix64(3);
        let values: Vec<f64> = (0..20_000).map(|_| random.normal()).collect();
        let mean = values.iter().sum::<f64>() / 20_000.0;
        let variance = values.iter().map(|v| v * v).sum::<f64>() / 20_000.0;
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.05, "{mean} {variance}");
    }

    #[test]
    fn a_bumped_normal_stays_unit_and_without_amplitude_stays_itself() {
        let mut bump = Bump { amplitude: 0.3, frequency_per_m: 8.0, seed: 1 };
        let mut greatest = 0.0f64;
        for p in points() {
            let n = p.normalize();
            let tilted = bumped(n, p, &bump);
            assert!((tilted.length() - 1.0).abs() < 1e-14 && tilted.dot(n) > 0.0);
            greatest = greatest.max(tilted.angle_between(n));
        }
        assert!((0.2..1.2).contains(&greatest), "{greatest}");
        bump.amplitude = 0.0;
        assert!(bumped(DVec3::Y, DVec3::ONE, &bump) == DVec3::Y);
    }
}
