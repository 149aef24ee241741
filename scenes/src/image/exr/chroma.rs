//! Channels with fewer samples than pixels, and luminance with chroma.

use super::header::Window;
use glam::DVec3;

/// Weights of the samples 1, 3, 5, … places away from a pixel between two.
///
/// Source: the odd taps of the reconstruction filter that "Luminance/Chroma
/// Images" in the Technical Introduction to OpenEXR describes, as the library
/// has them (`ImfRgbaYca.cpp`).
const TAPS: [f64; 7] =
    [0.627_123, -0.186_077, 0.087_929, -0.043_159, 0.019_597, -0.007_540, 0.002_128];

/// The samples of a subsampled channel, rows from the top.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    /// The pixels that they stand for.
    pub(super) window: Window,
    /// Every how many pixels there is one, in x and y.
    pub(super) sampling: [usize; 2],
    /// Columns and rows.
    pub(super) size: [usize; 2],
    pub(super) values: Vec<f64>,
}

impl Samples {
    /// A value for every pixel of the window. Samples lie on the pixels whose
    /// coordinates the step divides; at a border the last one goes on.
    pub(super) fn at_every_pixel(&self) -> Vec<f64> {
        let [width, height] = self.window.size_px().map(|n| n as usize);
        let [columns, rows] = self.size;
        if columns == 0 || rows == 0 {
            return vec![0.0; width * height];
        }
        let [x, y] = [0, 1].map(|axis| Line {
            first: self.window.min[axis],
            step: self.sampling[axis] as i64,
            count: self.size[axis],
        });
        let mut wide = Vec::with_capacity(width * rows);
        for row in self.values.chunks_exact(columns) {
            wide.extend((0..width).map(|place| x.at(place, |i| row[i])));
        }
        let mut full = Vec::with_capacity(width * height);
        for place in 0..height {
            full.extend((0..width).map(|column| y.at(place, |i| wide[i * width + column])));
        }
        full
    }
}

/// Samples along one axis.
struct Line {
    /// Coordinate of the first pixel.
    first: i64,
    step: i64,
    count: usize,
}

impl Line {
    /// The value at a pixel, counted from the first.
    fn at(&self, place: usize, sample: impl Fn(usize) -> f64) -> f64 {
        let pixel = self.first + place as i64;
        let origin = (self.first + self.step - 1).div_euclid(self.step);
        let before = pixel.div_euclid(self.step) - origin;
        let rest = pixel.rem_euclid(self.step);
        let held = |i: i64| sample(i.clamp(0, self.count as i64 - 1) as usize);
        if rest == 0 {
            return held(before);
        }
        if self.step == 2 {
            let pairs = TAPS.iter().zip(0..);
            return pairs.map(|(tap, i)| tap * (held(before - i) + held(before + 1 + i))).sum();
        }
        let share = rest as f64 / self.step as f64;
        held(before) * (1.0 - share) + held(before + 1) * share
    }
}

/// Turns RY = (R - Y) / Y, Y, BY = (B - Y) / Y into R, G, B, in place.
/// `weights`: shares of R, G, B in the luminance.
pub(super) fn to_rgb(pixels: &mut [f64], weights: DVec3) {
    for pixel in pixels.chunks_exact_mut(3) {
        let [ry, y, by] = [pixel[0], pixel[1], pixel[2]];
        let (red, blue) = ((ry + 1.0) * y, (by + 1.0) * y);
        let green = (y - weights.x * red - weights.z * blue) / weights.y;
        pixel.copy_from_slice(&[red, green, blue]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A filter that interpolates keeps constants and, away from borders, lines.
    #[test]
    fn constants_and_ramps_come_back() {
        let window = Window { min: [-8, 2], max: [71, 5] };
        let ramp = |window: Window| Samples {
            window,
            sampling: [2, 2],
            size: [40, 2],
            values: (0..80).map(|i| f64::from(i % 40) * 2.0 - 8.0).collect(),
        };
        let full = ramp(window).at_every_pixel();
        for (x, value) in full.iter().enumerate().take(66).skip(14) {
            assert!((value - (x as f64 - 8.0)).abs() < 1e-3, "{x}: {value}");
        }
        let sum: f64 = TAPS.iter().sum::<f64>() * 2.0;
        assert!((sum - 1.0).abs() < 1e-5);
    }

    /// Grey has no chroma; a colour comes back from its own luminance.
    #[test]
    fn chroma_is_the_difference_to_the_luminance() {
        let weights = DVec3::new(0.2126, 0.7152, 0.0722);
        let colour = DVec3::new(0.8, 0.3, 0.1);
        let y = weights.dot(colour);
        let mut pixels = [(colour.x - y) / y, y, (colour.z - y) / y, 0.0, 0.25, 0.0];
        to_rgb(&mut pixels, weights);
        for (found, expected) in pixels.iter().zip([0.8, 0.3, 0.1, 0.25, 0.25, 0.25]) {
            assert!((found - expected).abs() < 1e-12, "{pixels:?}");
        }
    }
}
