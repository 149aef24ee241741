//! The image files of one scene, read and measured pixel by pixel.

use super::colour_map;
use super::picture::Picture;
use crate::metric::{Exposures, exit_angle, flip};
use crate::report::ReportError;
use crate::report::runs::methods_of;
use crate::results::{FLIP_LAYER, REFERENCE, Run, SceneEntry, Study};
use scenes::{LayerName, Layers};
use std::path::Path;

/// Pictures of a scene in full size.
pub(in crate::report) struct ScenePictures {
    /// Exact.
    pub(in crate::report) exact: Picture,
    /// Each method's, where it has an image.
    pub(in crate::report) methods: Vec<Option<MethodPictures<Picture>>>,
}

/// Pictures of one method in one scene, in some form.
#[derive(Clone, Debug)]
pub(in crate::report) struct MethodPictures<T> {
    /// Radiance at the scene's exposure.
    pub(in crate::report) image: T,
    /// FLIP map.
    pub(in crate::report) flip: Option<T>,
    /// Exit-angle errors.
    pub(in crate::report) angle: Option<T>,
}

/// The exact image and each method's, in the order of the study.
pub(in crate::report) struct SceneImages {
    pub(in crate::report) ev: f64,
    pub(in crate::report) size_px: [usize; 2],
    /// Radiance of the exact image.
    pub(in crate::report) reference: Option<Vec<f64>>,
    /// `None` where the file has no radiance of this size.
    pub(in crate::report) methods: Vec<Option<MethodImage>>,
}

/// One method's image with its error maps.
pub(in crate::report) struct MethodImage {
    pub(in crate::report) size_px: [usize; 2],
    pub(in crate::report) radiance: Vec<f64>,
    pub(in crate::report) flip: Option<Vec<f64>>,
    pub(in crate::report) angle_deg: Option<Vec<f64>>,
}

impl SceneImages {
    /// Reads what exists; a run without an image file has no picture.
    pub(in crate::report) fn read(
        directory: &Path,
        study: &Study,
        entry: &SceneEntry,
    ) -> Result<Self, ReportError> {
        let exact = study
            .runs
            .iter()
            .find(|run| run.scene == entry.name && run.method == REFERENCE && has_image(run));
        let exact = exact.map(|run| layers(directory, run)).transpose()?;
        let radiance =
            exact.as_ref().and_then(|layers| layers.get(&LayerName::Radiance)).map(|l| &l.data);
        let mut images = Self {
            ev: radiance.map_or(0.0, |radiance| colour_map::exposure(radiance)),
            size_px: exact.as_ref().map_or([0, 0], |l| l.resolution_px.map(|side| side as usize)),
            reference: radiance.cloned(),
            methods: Vec::new(),
        };
        let exposures = match entry.flip_exposures {
            Some((start, stop, count)) => Some(Exposures { start, stop, count: count as usize }),
            None => radiance.and_then(|radiance| Exposures::of(radiance)),
        };
        for run in methods_of(study, &entry.name) {
            let image = if has_image(run) { Some(layers(directory, run)?) } else { None };
            let stored = stored_flip(directory, run)?;
            let measured = image
                .zip(exact.as_ref())
                .and_then(|(image, exact)| MethodImage::new(&image, exact, exposures, stored));
            images.methods.push(measured);
        }
        Ok(images)
    }

    /// All pictures in full size; none without an exact image.
    pub(in crate::report) fn pictures(&self) -> Option<ScenePictures> {
        let exact = Picture::of_radiance(self.reference.as_ref()?, self.size_px, self.ev);
        let methods = self.methods.iter().map(|image| image.as_ref().map(|i| i.pictures(self.ev)));
        Some(ScenePictures { exact, methods: methods.collect() })
    }
}

impl MethodImage {
    fn new(
        image: &Layers,
        exact: &Layers,
        exposures: Option<Exposures>,
        stored_flip: Option<Vec<f64>>,
    ) -> Option<Self> {
        if image.resolution_px != exact.resolution_px {
            return None;
        }
        let size_px = image.resolution_px.map(|side| side as usize);
        let layer = |layers: &Layers, name| -> Option<Vec<f64>> {
            layers.get(&name).filter(|layer| layer.channels == 3).map(|layer| layer.data.clone())
        };
        let radiance = layer(image, LayerName::Radiance)?;
        let reference = layer(exact, LayerName::Radiance);
        let measure = || {
            let (reference, exposures) = reference.zip(exposures)?;
            flip::hdr_flip_map(&reference, &radiance, size_px, exposures).ok()
        };
        let flip = stored_flip.filter(|map| map.len() == image.pixels()).or_else(measure);
        let angle_deg = layer(exact, LayerName::Exit)
            .zip(layer(image, LayerName::Exit))
            .map(|(r, t)| exit_angle::exit_angle_map_deg(&r, &t));
        Some(Self { size_px, radiance, flip, angle_deg })
    }

    /// Its pictures in full size.
    fn pictures(&self, ev: f64) -> MethodPictures<Picture> {
        MethodPictures {
            image: Picture::of_radiance(&self.radiance, self.size_px, ev),
            flip: self.flip.as_ref().map(|map| Picture::of_flip(map, self.size_px)),
            angle: self.angle_deg.as_ref().map(|map| Picture::of_angles(map, self.size_px)),
        }
    }
}

fn has_image(run: &Run) -> bool {
    !run.image.as_os_str().is_empty()
}

fn layers(directory: &Path, run: &Run) -> Result<Layers, ReportError> {
    Ok(scenes::image::read(&directory.join(&run.image))?)
}

/// The FLIP map that the study kept, if it did.
fn stored_flip(directory: &Path, run: &Run) -> Result<Option<Vec<f64>>, ReportError> {
    if run.flip_map.as_os_str().is_empty() {
        return Ok(None);
    }
    let mut layers = scenes::image::read(&directory.join(&run.flip_map))?;
    layers.list.retain(|layer| layer.name == LayerName::Buffer(FLIP_LAYER.to_owned()));
    Ok(layers.list.pop().map(|layer| layer.data))
}
