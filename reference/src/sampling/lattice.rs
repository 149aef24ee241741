//! One pattern of positions for every pixel.
//!
//! Source: I. H. Sloan, S. Joe, "Lattice Methods for Multiple Integration",
//! Oxford 1994, §4 (rank-1 rules; those of Fibonacci are the best in the plane).

use glam::DVec2;

/// A lattice of n points in the unit square: a row and a column for each, and
/// the whole symmetric about the centre, so that what changes evenly over the
/// square has its exact mean.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice {
    count: u32,
    generator: u32,
}

impl Lattice {
    /// The best for a Fibonacci number; `count` is at least 1.
    pub(crate) fn new(count: u32) -> Self {
        let golden = (f64::from(count) / std::f64::consts::GOLDEN_RATIO).round() as u32;
        // The nearest without a common divisor: none is far.
        let around = (0..count).flat_map(|d| [golden.saturating_sub(d), golden + d]);
        let generator = around.into_iter().find(|g| divisor(*g, count) == 1).unwrap_or(1);
        // Of a generator and its mirror image the odd one, which leaves the edges free.
        let even = generator % 2 == 0;
        Self { count, generator: if even { count - generator } else { generator } }
    }

    /// The point of a number below the count.
    pub(crate) fn at(self, number: u32) -> DVec2 {
        let twice = 2 * u64::from(self.count);
        let row = 2 * u64::from(number) + 1;
        let column = row * u64::from(self.generator) % twice;
        DVec2::new(row as f64, column as f64) / twice as f64
    }
}

/// The greatest common one.
fn divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_has_a_row_and_a_column_of_its_own() {
        for count in 1..=300 {
            let lattice = Lattice::new(count);
            let points: Vec<DVec2> = (0..count).map(|i| lattice.at(i)).collect();
            for axis in 0..2 {
                let mut places: Vec<f64> = points.iter().map(|p| p[axis]).collect();
                places.sort_by(f64::total_cmp);
                for (i, place) in places.iter().enumerate() {
                    let centre = (i as f64 + 0.5) / f64::from(count);
                    assert!((place - centre).abs() < 1e-12, "{count}: {place}");
                }
            }
            let opposite = |p: &DVec2| points.iter().any(|q| (*p + *q - 1.0).length() < 1e-12);
            assert!(points.iter().all(opposite), "{count}");
        }
    }

    /// Fibonacci's: the points are as far apart as n points can nearly be.
    #[test]
    fn points_keep_their_distance() {
        for count in [5, 8, 13, 21, 34, 55, 89] {
            let lattice = Lattice::new(count);
            let apart = (1..count).map(|i| {
                let d = (lattice.at(i) - lattice.at(0)).abs();
                d.min(1.0 - d).length()
            });
            let nearest = apart.fold(f64::INFINITY, f64::min);
            assert!(nearest * f64::from(count).sqrt() > 0.89, "{count}: {nearest}");
        }
    }
}
