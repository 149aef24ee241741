//! FLIP: the difference that a viewer sees when two images are flipped in
//! place; per pixel 0 to 1, pooled by the mean, 0 is best.
//!
//! Sources: Andersson et al., *FLIP: A Difference Evaluator for Alternating
//! Images*, PACMCGIT 3(2), 2020; Andersson et al., *Visualizing Errors in
//! Rendered High Dynamic Range Images*, Eurographics 2021 Short Papers.
//! The arithmetic is `flip-rs`, which golden vectors of FLIP 1.7 check.

use flip_rs::{HdrOptions, RgbImage, Tonemapper};
use serde::{Deserialize, Serialize};

/// Pixels per degree of visual angle: 0.7 m from a screen 0.7 m and 3840
/// pixels wide, FLIP's own default.
pub const PIXELS_PER_DEGREE: f64 = 67.020_645_141_601_56;

/// Exposures of HDR-FLIP, powers of two, first and last included. Pinned per
/// scene: chosen by each image anew, one firefly moves them by five stops.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Exposures {
    /// First, stops.
    pub start: f64,
    /// Last, stops.
    pub stop: f64,
    /// How many, 2 to 128.
    pub count: usize,
}

/// Most exposures that are chosen without being asked for.
const MOST_STOPS: f64 = 12.0;
/// Where FLIP's ACES curve, (0.9036 x² + 0.018 x) / (0.8748 x² + 0.354 x +
/// 0.14), reaches 0.85.
const ACES_AT_85_PERCENT: f64 = 2.118_866;

impl Exposures {
    /// Exposures for a reference image (linear, interleaved), in whole stops:
    /// from the one that shows the brightest 0.1 % of the lit pixels at 85 %
    /// to the one that shows their median so, at most 12 stops apart. `None`
    /// when nothing in the image is lit.
    ///
    /// FLIP's own choice takes the one brightest pixel and counts black
    /// pixels in the median; a mostly black image then gets +24 stops.
    #[must_use]
    pub fn of(reference: &[f64]) -> Option<Self> {
        let mut lit: Vec<f64> = reference
            .chunks_exact(3)
            .map(|p| 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2])
            .filter(|&luminance| luminance.is_finite() && luminance > 0.0)
            .collect();
        lit.sort_unstable_by(f64::total_cmp);
        let bright = crate::support::sum::quantile(&lit, 0.999)?;
        let median = crate::support::sum::quantile(&lit, 0.5)?;
        let start = (ACES_AT_85_PERCENT / bright).log2().floor().clamp(-60.0, 60.0);
        let stop = (ACES_AT_85_PERCENT / median).log2().ceil();
        let stop = stop.clamp(start + 1.0, start + MOST_STOPS);
        Some(Self { start, stop, count: (stop - start) as usize + 1 })
    }
}

/// A FLIP map, or why there is none.
pub type FlipMap = Result<Vec<f64>, String>;

/// HDR-FLIP of each pixel: the largest LDR-FLIP over the exposures, with the
/// ACES curve. Inputs: linear Rec.709, interleaved.
pub fn hdr_flip_map(
    reference: &[f64],
    candidate: &[f64],
    size_px: [usize; 2],
    exposures: Exposures,
) -> FlipMap {
    let mut options = HdrOptions::default();
    options.tonemapper = Tonemapper::Aces;
    options.start_exposure = Some(exposures.start as f32);
    options.stop_exposure = Some(exposures.stop as f32);
    options.num_exposures = Some(exposures.count);
    options.return_exposure_map = false;
    let result =
        flip_rs::hdr_flip(&image(reference, size_px)?, &image(candidate, size_px)?, options);
    Ok(map(result.map_err(|error| error.to_string())?.error_map))
}

/// LDR-FLIP of each pixel. Inputs: display-encoded sRGB, 0..1, interleaved.
pub fn ldr_flip_map(
    reference: &[f64],
    candidate: &[f64],
    size_px: [usize; 2],
    pixels_per_degree: f64,
) -> FlipMap {
    let (reference, candidate) = (image(reference, size_px)?, image(candidate, size_px)?);
    let result = flip_rs::ldr_flip(&reference, &candidate, pixels_per_degree as f32);
    Ok(map(result.map_err(|error| error.to_string())?))
}

fn image(values: &[f64], [width, height]: [usize; 2]) -> Result<RgbImage<f32>, String> {
    let narrow = values.iter().map(|&value| value as f32).collect();
    RgbImage::new(width, height, narrow).map_err(|error| error.to_string())
}

fn map(map: flip_rs::ErrorMap) -> Vec<f64> {
    map.into_pixels().into_iter().map(f64::from).collect()
}
