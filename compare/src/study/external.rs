//! An image that somebody else made, judged like ours.
//!
//! A display-encoded image (PNG and others) holds sRGB code values of light up to 1. It is
//! decoded, and the truth that it is compared with is cut off at 1 as it is. An
//! image that is shifted by whole pixels, as half-pixel conventions and borders do
//! to others, is moved back; both are stated in rows of their own.

use super::judge::{Judge, count_row};
use super::output::{FLIP, IMAGE};
use super::sweep::External;
use super::{Outcome, output};
use crate::Error;
use crate::metric::Encoding;
use crate::results::{NotDone, ResultRow, RowKind, Run};
use crate::study::jobs::Made;
use scenes::image::Alpha;
use scenes::{LayerName, Layers};
use std::path::Path;

/// Farthest shift that is looked for, pixels.
const FARTHEST_PX: i32 = 4;
/// A shift is believed if it leaves at most this share of the difference.
const BELIEVED: f64 = 0.8;

/// Judges the image; its files go to a folder.
pub(super) fn outcome(
    external: &External,
    mut run: Run,
    common: &ResultRow,
    truth: &Made,
    judge: &Judge,
    folder: &Path,
) -> Result<Outcome, Error> {
    let image = scenes::image::open(&external.image, Alpha::OverBlack)?;
    let refuse = |why: &str| Error::Image { path: external.image.clone(), why: why.to_owned() };
    let radiance = image.layers.get(&LayerName::Radiance).filter(|layer| layer.channels == 3);
    let mut radiance = radiance.ok_or_else(|| refuse("it has no channels R, G, B"))?.data.clone();
    let display = image.encoding == Encoding::Display;
    if display {
        radiance.iter_mut().for_each(|value| *value = from_code_value(*value));
    }
    let mut layers = truth.layers.clone();
    if display {
        let clipped = |layers: &Layers| {
            let light =
                layers.get(&LayerName::Radiance).map(|l| l.data.clone()).unwrap_or_default();
            light.into_iter().map(|value| value.min(1.0)).collect::<Vec<_>>()
        };
        layers = with_radiance(&layers, clipped(&truth.layers));
    }
    let size = truth.layers.resolution_px.map(|side| side as i32);
    let exact = layers.get(&LayerName::Radiance).map(|l| l.data.as_slice()).unwrap_or_default();
    let shift = shift(exact, &radiance, size);
    let moved = shifted(&radiance, size, shift);
    let mut own = Layers::new(truth.layers.resolution_px);
    own.push(LayerName::Radiance, 3, moved);
    output::write_image(&folder.join(IMAGE), &own, common)?;

    let judged = judge.judged_against(&layers, &own, common)?;
    let mut rows = judged.rows;
    rows.push(count_row("display_encoded", f64::from(u8::from(display)), common));
    rows.push(count_row("shift_x_px", f64::from(shift[0]), common));
    rows.push(count_row("shift_y_px", f64::from(shift[1]), common));
    if let Some(milliseconds) = external.milliseconds {
        let metric = "time_given_ms".to_owned();
        let (kind, unit, positions) = (RowKind::Time, "ms".to_owned(), common.positions);
        let value = Some(milliseconds);
        let row = count_row("", 0.0, common);
        rows.push(ResultRow { kind, metric, unit, value, n: 1, positions, ..row });
    }
    let what = format!("{} × {}", run.scene, run.method);
    let told = image.warnings.iter().map(|reason| (what.clone(), reason.clone()));
    let left_out = told.map(|(what, reason)| NotDone { what, reason }).collect();
    run.metrics_left_out = judged.left_out;
    if let Some(map) = judged.flip_map {
        run.flip_map = FLIP.into();
        output::write_flip(&folder.join(FLIP), common, map)?;
    }
    Ok(Outcome { run: Some(run), rows, left_out, ..Outcome::default() })
}

/// The same layers with another radiance.
fn with_radiance(layers: &Layers, radiance: Vec<f64>) -> Layers {
    let mut other = Layers::new(layers.resolution_px);
    other.push(LayerName::Radiance, 3, radiance);
    for layer in layers.list.iter().filter(|layer| layer.name != LayerName::Radiance) {
        other.push(layer.name.clone(), layer.channels, layer.data.clone());
    }
    other
}

/// Light of an sRGB code value, 0 to 1.
///
/// Source: IEC 61966-2-1.
fn from_code_value(code: f64) -> f64 {
    if code <= 0.040_45 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

/// By how many whole pixels the image has to move, to the right and down, to lie
/// on the exact one; zero unless that makes it clearly more alike.
fn shift(exact: &[f64], image: &[f64], size: [i32; 2]) -> [i32; 2] {
    let tone = |data: &[f64]| -> Vec<f64> {
        data.chunks_exact(3)
            .map(|p| (1.0 + p.iter().map(|v| v.max(0.0)).sum::<f64>()).ln())
            .collect()
    };
    let (exact, image) = (tone(exact), tone(image));
    let [width, height] = size;
    let border = FARTHEST_PX;
    if width <= 4 * border || height <= 4 * border {
        return [0, 0];
    }
    let difference = |[dx, dy]: [i32; 2]| -> f64 {
        let rows = border..height - border;
        let row = |y: i32| -> f64 {
            let at = |x: i32, y: i32| (y * width + x) as usize;
            let pixel = |x: i32| (exact[at(x, y)] - image[at(x - dx, y - dy)]).abs();
            (border..width - border).map(pixel).sum()
        };
        rows.map(row).sum()
    };
    let unmoved = difference([0, 0]);
    let all = (-border..=border).flat_map(|dy| (-border..=border).map(move |dx| [dx, dy]));
    let best = all.map(|by| (difference(by), by)).min_by(|a, b| a.0.total_cmp(&b.0));
    best.filter(|(left, _)| *left < BELIEVED * unmoved).map_or([0, 0], |(_, by)| by)
}

/// The image moved to the right and down; what comes in from outside repeats the
/// border.
fn shifted(image: &[f64], [width, height]: [i32; 2], [dx, dy]: [i32; 2]) -> Vec<f64> {
    let pixel = |x: i32, y: i32| {
        let (x, y) = ((x - dx).clamp(0, width - 1), (y - dy).clamp(0, height - 1));
        let at = 3 * (y * width + x) as usize;
        [image[at], image[at + 1], image[at + 2]]
    };
    (0..height).flat_map(|y| (0..width).flat_map(move |x| pixel(x, y))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(centre: [f64; 2]) -> Vec<f64> {
        let value = |x: i32, y: i32| {
            let r = (f64::from(x) - centre[0]).hypot(f64::from(y) - centre[1]);
            if r < 9.0 { 2.0 - 0.1 * r } else { 0.1 }
        };
        (0..40).flat_map(|y| (0..48).flat_map(move |x| [value(x, y); 3])).collect()
    }

    /// A disc that lies three pixels to the left and one too low is moved back; one
    /// in its place, and one that is wrong in another way, stay.
    #[test]
    fn a_shift_of_whole_pixels_is_found_and_undone() {
        let exact = disc([24.0, 20.0]);
        let moved = disc([21.0, 21.0]);
        assert_eq!(shift(&exact, &moved, [48, 40]), [3, -1]);
        assert_eq!(shifted(&moved, [48, 40], [3, -1]), exact);
        assert_eq!(shift(&exact, &exact, [48, 40]), [0, 0]);
        let darker: Vec<f64> = exact.iter().map(|v| 0.5 * v).collect();
        assert_eq!(shift(&exact, &darker, [48, 40]), [0, 0]);
    }

    /// IEC 61966-2-1: code value 0.5 is 0.21404 of white.
    #[test]
    fn code_values_become_light() {
        assert!((from_code_value(0.5) - 0.214_041_14).abs() < 1e-8);
        assert_eq!((from_code_value(0.0), from_code_value(1.0)), (0.0, 1.0));
    }
}
