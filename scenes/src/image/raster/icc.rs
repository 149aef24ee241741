//! ICC profiles: code values of a device become code values of sRGB.

use super::HALF_A_STEP;
use moxcms::{ColorProfile, DataColorSpace, Layout, TransformOptions};

/// Steps along each axis of the grid that tells whether a profile is sRGB.
const STEPS: u32 = 9;

/// Code values of sRGB for colours of a profile, `None` if they are that already:
/// no colour of a grid moves by more than half a step of 8 bits.
///
/// # Errors
/// If the profile cannot be used, with what is wrong.
pub(super) fn to_srgb(profile: &[u8], colours: &[f64]) -> Result<Option<Vec<f64>>, String> {
    let profile = ColorProfile::new_from_slice(profile)
        .map_err(|error| format!("its ICC profile is not readable ({error})"))?;
    let grid: Vec<f64> = match profile.color_space {
        DataColorSpace::Gray => (0..256).flat_map(|i| [f64::from(i) / 255.0; 3]).collect(),
        DataColorSpace::Rgb => grid(),
        other => return Err(format!("its ICC profile is for {other:?}")),
    };
    let moved = transform(&profile, &grid)?;
    let farthest = grid.iter().zip(&moved).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if farthest <= HALF_A_STEP { Ok(None) } else { transform(&profile, colours).map(Some) }
}

fn grid() -> Vec<f64> {
    let at = |i: u32| f64::from(i) / f64::from(STEPS - 1);
    let places = 0..STEPS * STEPS * STEPS;
    places.flat_map(|i| [at(i / STEPS / STEPS), at(i / STEPS % STEPS), at(i % STEPS)]).collect()
}

fn transform(profile: &ColorProfile, colours: &[f64]) -> Result<Vec<f64>, String> {
    let is_grey = profile.color_space == DataColorSpace::Gray;
    let layout = if is_grey { Layout::Gray } else { Layout::Rgb };
    let srgb = ColorProfile::new_srgb();
    let made =
        profile.create_transform_f64(layout, &srgb, Layout::Rgb, TransformOptions::default());
    let unusable = |error| format!("its ICC profile cannot be used ({error})");
    let mut moved = vec![0.0; colours.len()];
    let executor = made.map_err(unusable)?;
    if is_grey {
        let grey: Vec<f64> = colours.iter().step_by(3).copied().collect();
        executor.transform(&grey, &mut moved).map_err(unusable)?;
    } else {
        executor.transform(colours, &mut moved).map_err(unusable)?;
    }
    Ok(moved)
}
