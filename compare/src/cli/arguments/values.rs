//! Values of arguments, read from the words that people write.

use crate::metric::Exposures;
use scenes::image::Alpha;
use std::path::{Path, PathBuf};

/// True for the name of a .png file.
pub(in crate::cli) fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}

/// Reads the name of a .exr or .png file.
pub(in crate::cli) fn image_path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_exr = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr"));
    if is_exr || is_png(&path) {
        Ok(path)
    } else {
        Err("write a name that ends in .exr or .png".into())
    }
}

/// Reads the name of a .exr file.
pub(in crate::cli) fn exr_path(text: &str) -> Result<PathBuf, String> {
    let path = image_path(text)?;
    if is_png(&path) { Err("write a name that ends in .exr".into()) } else { Ok(path) }
}

/// Reads `WIDTHxHEIGHT`, or one number for both.
pub(in crate::cli) use crate::study::sweep::file::resolution;

/// Reads `START,STOP,COUNT`.
pub(in crate::cli) fn exposures(text: &str) -> Result<Exposures, String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let [start, stop, count] = parts[..] else {
        return Err("write START,STOP,COUNT, such as -4,2,7".to_owned());
    };
    let stops = |text: &str| {
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        value.ok_or_else(|| format!("`{text}` is no number of stops"))
    };
    let count = count.parse().ok().filter(|count| (2..=64).contains(count));
    let count = count.ok_or("COUNT is a whole number from 2 to 64")?;
    Ok(Exposures { start: stops(start)?, stop: stops(stop)?, count })
}

/// Reads what transparent pixels lie over.
pub(in crate::cli) fn alpha(text: &str) -> Result<Alpha, String> {
    let named = Alpha::ALL.into_iter().find(|alpha| alpha.name() == text);
    named.ok_or_else(|| format!("write one of {}", Alpha::ALL.map(Alpha::name).join(", ")))
}

/// Reads `ev=STOPS`.
pub(in crate::cli) fn display_ev(text: &str) -> Result<f64, String> {
    let stops = text.strip_prefix("ev=").and_then(|stops| stops.trim().parse::<f64>().ok());
    let stops = stops.filter(|stops| stops.abs() <= 100.0);
    stops.ok_or_else(|| "write ev=STOPS, such as ev=-0.5".to_owned())
}

/// Reads `NAME=VALUE`.
pub(in crate::cli) fn parameter(text: &str) -> Result<(String, String), String> {
    let parts = text.split_once('=').map(|(name, value)| (name.trim(), value.trim()));
    match parts {
        Some((name, value)) if !name.is_empty() && !value.is_empty() => {
            Ok((name.to_owned(), value.to_owned()))
        }
        _ => Err("write NAME=VALUE, such as a=0.33".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::resolution;

    #[test]
    fn a_resolution_is_two_numbers_or_one() {
        assert_eq!(resolution("640x360"), Ok([640, 360]));
        assert_eq!(resolution("256"), Ok([256, 256]));
        for wrong in ["", "0x4", "512x", "20000x2", "-1", "a"] {
            assert!(resolution(wrong).is_err(), "{wrong}");
        }
    }
}
