//! Owen-scrambled Sobol points: a number for each (pixel, sample, dimension),
//! the same whatever was drawn before.
//!
//! Sources: B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020;
//! S. Laine, T. Karras, "Stratified Sampling for Stochastic Transparency",
//! Computer Graphics Forum 30(4), 2011.

/// The points of one pixel and batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Points {
    seed: u32,
}

impl Points {
    /// Points that have nothing to do with those of other pixels or batches.
    pub(crate) fn new(seed: u64, pixel: u64, batch: u32) -> Self {
        let low = hash(seed as u32 ^ hash(pixel as u32));
        let high = hash((seed >> 32) as u32 ^ hash((pixel >> 32) as u32 ^ 0x5bd1_e995));
        Self { seed: hash(low ^ high.rotate_left(11) ^ hash(batch.wrapping_add(0x9e37_79b9))) }
    }

    /// Two coordinates of a point, each in (0, 1). Every pair of dimensions is
    /// a (0, 2)-sequence in base 2; different pairs are shuffled independently.
    pub(crate) fn pair(&self, sample: u32, pair: u32) -> [f64; 2] {
        let seed = hash(self.seed ^ hash(pair));
        let index = scramble(sample, seed);
        let [x, y] = sobol(index);
        [scramble(x, hash(seed ^ 0x68bc_21eb)), scramble(y, hash(seed ^ 0x02e5_be93))]
            .map(|bits| (f64::from(bits) + 0.5) / 4_294_967_296.0)
    }
}

/// The first two dimensions of Sobol's sequence.
fn sobol(index: u32) -> [u32; 2] {
    let (mut y, mut column) = (0, 1_u32 << 31);
    let mut rest = index;
    while rest != 0 {
        if rest & 1 != 0 {
            y ^= column;
        }
        column ^= column >> 1;
        rest >>= 1;
    }
    [index.reverse_bits(), y]
}

/// Owen's nested uniform scramble: each bit is flipped by a hash of the bits
/// above it.
fn scramble(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x21f0_aaad);
    x ^= x >> 15;
    x = x.wrapping_mul(0xd35a_2d97);
    x ^ (x >> 15)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2^m points put one into every elementary box of area 2^-m.
    #[test]
    fn points_fill_every_elementary_box_once() {
        for (pixel, pair) in [(0, 0), (17, 3), (40_000, 9)] {
            let points = Points::new(5, pixel, 2);
            let m = 8_u32;
            for columns in 0..=m {
                let mut filled = vec![0; 1 << m];
                for sample in 0..1 << m {
                    let [x, y] = points.pair(sample, pair);
                    let column = (x * f64::from(1_u32 << columns)) as usize;
                    let row = (y * f64::from(1_u32 << (m - columns))) as usize;
                    filled[(row << columns) + column] += 1;
                }
                assert!(filled.iter().all(|count| *count == 1), "{columns}");
            }
        }
    }

    /// The mean of x y over 4,096 points of unrelated pixels: no correlation.
    #[test]
    fn pixels_and_batches_are_independent() {
        let mut sum = 0.0;
        for pixel in 0..4096 {
            let [a, b] = [0, 1].map(|batch| Points::new(1, pixel, batch).pair(0, 0)[0] - 0.5);
            sum += a * b;
        }
        // The standard deviation of the mean is 1 / (12 · 64).
        assert!((sum / 4096.0).abs() < 4.0 / 768.0, "{sum}");
    }
}
