//! The baseline: one file with everything that was accepted.
//!
//! A line that names the form, a line of JSON, then the images one after
//! another, where the JSON says. Truths lie in it beside bases, so that a check
//! renders no exact image again whose hash is unchanged, on any machine.

use super::half_image::HalfImage;
use crate::gate::{AdapterClass, GateError};
use crate::metric::Exposures;
use crate::support::files;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

const FORM: &str = "snell.baseline/1";
/// Most bytes of a baseline: it is kept with the sources.
pub const MOST_BYTES: usize = 32 << 20;

/// Everything that was accepted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Baseline {
    /// Exact images by name: a scene, or a pair.
    pub truths: BTreeMap<String, KeptTruth>,
    /// What is watched, by name.
    pub cells: BTreeMap<String, KeptCell>,
}

/// An exact image.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptTruth {
    /// Hash of everything that it depends on.
    pub id: String,
    /// Radiance, or code values.
    pub mean: HalfImage,
    /// Standard error of each value, where it has noise.
    pub standard_error: Option<HalfImage>,
    /// r0 of the weights 1 / (r0² + 0.01), where `mean` has noise.
    pub frozen: Option<HalfImage>,
    /// Exposures of HDR-FLIP; none for code values.
    pub exposures: Option<Exposures>,
}

/// An accepted image of a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptCell {
    /// Name of its truth.
    pub truth: String,
    /// Hash of what it shows: the scene and every setting of the gate.
    pub inputs: String,
    /// Adapter that it was accepted on; none for files.
    pub adapter: Option<AdapterClass>,
    /// Its name and driver.
    pub device: String,
    /// One image per seed.
    pub images: Vec<HalfImage>,
    /// Every metric when it was accepted.
    pub numbers: BTreeMap<String, f64>,
    /// Deterministic counts of work.
    pub work: BTreeMap<String, u64>,
}

/// Where an image lies behind the JSON.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Place {
    size_px: [u32; 2],
    stops: i32,
    offset: usize,
    bytes: usize,
}

/// The line of JSON.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Index {
    version: String,
    truths: BTreeMap<String, TruthEntry>,
    cells: BTreeMap<String, CellEntry>,
}

#[derive(Serialize, Deserialize)]
struct TruthEntry {
    id: String,
    mean: Place,
    standard_error: Option<Place>,
    frozen: Option<Place>,
    exposures: Option<Exposures>,
}

#[derive(Serialize, Deserialize)]
struct CellEntry {
    truth: String,
    inputs: String,
    adapter: Option<AdapterClass>,
    device: String,
    images: Vec<Place>,
    numbers: BTreeMap<String, f64>,
    work: BTreeMap<String, u64>,
}

impl Baseline {
    /// Writes the file, whole or not at all, and returns its size in bytes.
    ///
    /// # Errors
    /// If it would be larger than [`MOST_BYTES`] or cannot be written.
    pub fn write(&self, path: &Path) -> Result<usize, crate::Error> {
        let bytes = self.bytes();
        if bytes.len() > MOST_BYTES {
            let reason = format!(
                "the baseline would take {} MB, and is kept with the sources: at most {} MB; \
                 watch fewer cells or write a smaller resolution",
                bytes.len() >> 20,
                MOST_BYTES >> 20
            );
            return Err(GateError::file(path, reason).into());
        }
        files::write(path, &bytes)?;
        Ok(bytes.len())
    }

    fn bytes(&self) -> Vec<u8> {
        let mut images = Vec::new();
        let mut put = |image: &HalfImage| {
            let packed = image.pack();
            let (offset, bytes) = (images.len(), packed.len());
            images.extend(packed);
            Place { size_px: image.size_px, stops: image.stops, offset, bytes }
        };
        let truths = self.truths.iter().map(|(name, truth)| {
            let entry = TruthEntry {
                id: truth.id.clone(),
                mean: put(&truth.mean),
                standard_error: truth.standard_error.as_ref().map(&mut put),
                frozen: truth.frozen.as_ref().map(&mut put),
                exposures: truth.exposures,
            };
            (name.clone(), entry)
        });
        let truths = truths.collect();
        let cells = self.cells.iter().map(|(name, cell)| {
            let entry = CellEntry {
                truth: cell.truth.clone(),
                inputs: cell.inputs.clone(),
                adapter: cell.adapter,
                device: cell.device.clone(),
                images: cell.images.iter().map(&mut put).collect(),
                numbers: cell.numbers.clone(),
                work: cell.work.clone(),
            };
            (name.clone(), entry)
        });
        let cells = cells.collect();
        let index = Index { version: env!("CARGO_PKG_VERSION").to_owned(), truths, cells };
        // Maps with text for keys: it can always be written.
        let index = serde_json::to_string(&index).unwrap_or_default();
        let mut bytes = format!("{FORM}\n{index}\n").into_bytes();
        bytes.extend(images);
        bytes
    }

    /// Reads a file that [`Baseline::write`] wrote.
    ///
    /// # Errors
    /// If it is missing, of another form, or broken.
    pub fn read(path: &Path) -> Result<Self, GateError> {
        let bytes = std::fs::read(path)
            .map_err(|error| GateError::file(path, format!("cannot be read: {error}")))?;
        Self::of(&bytes).map_err(|reason| {
            let again = "restore the file, or accept the images again";
            GateError::file(path, format!("is no baseline that can be read: {reason}\n{again}"))
        })
    }

    fn of(bytes: &[u8]) -> Result<Self, String> {
        let line = |bytes: &[u8]| bytes.iter().position(|byte| *byte == b'\n');
        let first = line(bytes).ok_or("it has no first line")?;
        if bytes[..first] != *FORM.as_bytes() {
            return Err(format!("its first line is not {FORM}"));
        }
        let rest = &bytes[first + 1..];
        let second = line(rest).ok_or("it is cut off")?;
        let index: Index =
            serde_json::from_slice(&rest[..second]).map_err(|error| error.to_string())?;
        let images = &rest[second + 1..];
        let image = |place: Place| {
            let end = place.offset.checked_add(place.bytes);
            let packed =
                end.and_then(|end| images.get(place.offset..end)).ok_or("it is cut off")?;
            HalfImage::unpack(packed, place.size_px, place.stops).ok_or("an image is broken")
        };
        let mut found = Self::default();
        for (name, entry) in index.truths {
            let truth = KeptTruth {
                id: entry.id,
                mean: image(entry.mean)?,
                standard_error: entry.standard_error.map(image).transpose()?,
                frozen: entry.frozen.map(image).transpose()?,
                exposures: entry.exposures,
            };
            found.truths.insert(name, truth);
        }
        for (name, entry) in index.cells {
            let cell = KeptCell {
                truth: entry.truth,
                inputs: entry.inputs,
                adapter: entry.adapter,
                device: entry.device,
                images: entry.images.into_iter().map(image).collect::<Result<_, _>>()?,
                numbers: entry.numbers,
                work: entry.work,
            };
            found.cells.insert(name, cell);
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot use the disk must fail")]
    use super::*;

    fn baseline() -> Baseline {
        let image = |value: f64| HalfImage::of(&[value; 12], [2, 2]).unwrap();
        let truth = KeptTruth {
            id: "1".to_owned(),
            mean: image(1.0),
            standard_error: Some(image(0.1)),
            frozen: None,
            exposures: Some(Exposures { start: -1.0, stop: 2.0, count: 4 }),
        };
        let cell = KeptCell {
            truth: "ball".to_owned(),
            inputs: "2".to_owned(),
            adapter: Some(AdapterClass::Lavapipe),
            device: "llvmpipe".to_owned(),
            images: vec![image(2.0), image(3.0)],
            numbers: BTreeMap::from([("bias".to_owned(), 0.1 + 0.2)]),
            work: BTreeMap::from([("bytes".to_owned(), 17)]),
        };
        Baseline {
            truths: BTreeMap::from([("ball".to_owned(), truth)]),
            cells: BTreeMap::from([("ball/blended".to_owned(), cell)]),
        }
    }

    #[test]
    fn a_baseline_survives_the_disk() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/gate.baseline");
        let bytes = baseline().write(&path).unwrap();
        assert_eq!(bytes as u64, std::fs::metadata(&path).unwrap().len());
        assert_eq!(Baseline::read(&path).unwrap(), baseline());
    }

    #[test]
    fn a_broken_file_is_refused_wherever_it_is_cut() {
        let whole = baseline().bytes();
        assert_eq!(Baseline::of(&whole), Ok(baseline()));
        for length in 0..whole.len() {
            assert!(Baseline::of(&whole[..length]).is_err(), "cut after {length} bytes");
        }
    }
}
