//! Pictures for people: radiance at one exposure, error maps, PNG files.

use super::colour_map::{self, Colour};
use image::{ImageEncoder, codecs::png};

/// An 8-bit sRGB picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height, pixels.
    pub size_px: [usize; 2],
    /// Colours, rows from the top.
    pub pixels: Vec<Colour>,
}

impl Picture {
    /// A picture with one colour per pixel made from an index.
    pub fn from_fn(size_px: [usize; 2], colour: impl Fn(usize) -> Colour) -> Self {
        Self { size_px, pixels: (0..size_px[0] * size_px[1]).map(colour).collect() }
    }

    /// Radiance at an exposure.
    #[must_use]
    pub fn of_radiance(radiance: &[f64], size_px: [usize; 2], ev: f64) -> Self {
        Self::from_fn(size_px, |i| {
            colour_map::show([radiance[3 * i], radiance[3 * i + 1], radiance[3 * i + 2]], ev)
        })
    }

    /// A FLIP map.
    #[must_use]
    pub fn of_flip(map: &[f64], size_px: [usize; 2]) -> Self {
        Self::from_fn(size_px, |i| colour_map::flip(map[i]))
    }

    /// Exit-angle errors in degrees, NaN where there is none.
    #[must_use]
    pub fn of_angles(map_deg: &[f64], size_px: [usize; 2]) -> Self {
        Self::from_fn(size_px, |i| {
            if map_deg[i].is_nan() {
                colour_map::NOTHING
            } else {
                colour_map::ramp(colour_map::angle_share(map_deg[i]))
            }
        })
    }

    /// The picture shrunk by a whole factor until it is at most that wide:
    /// each pixel the mean of a block of code values.
    #[must_use]
    pub fn shrunk_to(&self, width_px: usize) -> Self {
        let factor = self.size_px[0].div_ceil(width_px).max(1);
        if factor == 1 {
            return self.clone();
        }
        let [width, height] = self.size_px;
        let small = [width.div_ceil(factor), height.div_ceil(factor)];
        Self::from_fn(small, |i| {
            let (x0, y0) = (i % small[0] * factor, i / small[0] * factor);
            let (mut total, mut count) = ([0u32; 3], 0u32);
            for y in y0..(y0 + factor).min(height) {
                for x in x0..(x0 + factor).min(width) {
                    let pixel = self.pixels[y * width + x];
                    total = std::array::from_fn(|c| total[c] + u32::from(pixel[c]));
                    count += 1;
                }
            }
            total.map(|sum| ((sum + count / 2) / count) as u8)
        })
    }

    /// The picture as a PNG file in memory.
    #[must_use]
    pub fn png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let encoder = png::PngEncoder::new_with_quality(
            &mut bytes,
            png::CompressionType::Default,
            png::FilterType::Adaptive,
        );
        let [width, height] = self.size_px.map(|side| side as u32);
        // Writing into memory does not fail.
        let _ = encoder.write_image(
            self.pixels.as_flattened(),
            width,
            height,
            image::ExtendedColorType::Rgb8,
        );
        bytes
    }
}

/// Pictures side by side in rows, with a gap of background between them; a
/// cell may be empty. All cells are as large as the first picture.
#[must_use]
pub fn contact_sheet(rows: &[Vec<Option<&Picture>>]) -> Option<Picture> {
    const GAP_PX: usize = 4;
    let [width, height] = rows.iter().flatten().flatten().next()?.size_px;
    let columns = rows.iter().map(Vec::len).max()?;
    let size_px = [columns * (width + GAP_PX) - GAP_PX, rows.len() * (height + GAP_PX) - GAP_PX];
    Some(Picture::from_fn(size_px, |i| {
        let (x, y) = (i % size_px[0], i / size_px[0]);
        let (column, row) = (x / (width + GAP_PX), y / (height + GAP_PX));
        let (x, y) = (x % (width + GAP_PX), y % (height + GAP_PX));
        let cell = rows[row].get(column).copied().flatten();
        match cell {
            Some(picture) if x < width && y < height && picture.size_px == [width, height] => {
                picture.pixels[y * width + x]
            }
            _ => [255; 3],
        }
    }))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]
    use super::*;

    #[test]
    fn a_png_holds_the_pixels() {
        let picture = Picture::from_fn([3, 2], |i| [i as u8, 7, 255]);
        let decoded = image::load_from_memory(&picture.png()).unwrap().into_rgb8();
        assert_eq!(decoded.as_raw(), picture.pixels.as_flattened());
    }

    #[test]
    fn shrinking_takes_the_mean_of_blocks_and_of_what_is_left_at_the_border() {
        let picture = Picture::from_fn([3, 1], |i| [i as u8 * 100; 3]);
        let small = picture.shrunk_to(2);
        assert_eq!((small.size_px, small.pixels), ([2, 1], vec![[50; 3], [200; 3]]));
    }

    #[test]
    fn a_contact_sheet_has_a_gap_and_blank_cells() {
        let picture = Picture::from_fn([2, 2], |_| [1; 3]);
        let sheet = contact_sheet(&[vec![Some(&picture), None]]).unwrap();
        assert_eq!(sheet.size_px, [8, 2]);
        assert_eq!(sheet.pixels[0], [1; 3]);
        assert_eq!(sheet.pixels[7], [255; 3]);
        assert!(contact_sheet(&[]).is_none());
    }
}
