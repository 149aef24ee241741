//! The job of tracing an exact image.

use super::Made;
use crate::Error;
use crate::study::cache::{Id, Store};
use reference::{Estimator, Level, Request, Watch};
use scenes::{LayerName, Scene, View};
use serde::Serialize;
use std::collections::BTreeMap;

/// Longer side of a glance, pixels.
const GLANCE_PX: u32 = 128;
/// Weight below which a glance cuts branches.
const GLANCE_CUT: f64 = 1e-3;

/// An exact image of a scene.
#[derive(Clone, Debug)]
pub struct Exact<'a> {
    /// What is rendered.
    pub scene: &'a Scene,
    /// How.
    pub request: Request,
}

/// All that the result depends on.
#[derive(Serialize)]
struct Description<'a> {
    sources: &'a str,
    scene: &'a str,
    request: String,
}

impl<'a> Exact<'a> {
    /// The truth that approximations are judged against: the full tree of
    /// refractions and reflections at k x k positions per pixel, and the exit
    /// direction of the primary chain.
    #[must_use]
    pub fn truth(scene: &'a Scene, resolution_px: [u32; 2], k: u32, cut: f64) -> Self {
        let layers = vec![
            LayerName::Radiance,
            LayerName::Coverage,
            LayerName::Exit,
            LayerName::Events,
            LayerName::Flags,
            LayerName::Truncated,
        ];
        Self::tree(scene, resolution_px, k, cut, layers)
    }

    /// A cheaper image for the exact renderer's own curve of error against
    /// time. It shares no camera ray with a truth at k' x k' positions if
    /// [`is_disjoint`] says so.
    #[must_use]
    pub fn estimate(scene: &'a Scene, resolution_px: [u32; 2], k: u32, cut: f64) -> Self {
        Self::tree(scene, resolution_px, k, cut, vec![LayerName::Radiance])
    }

    /// Radiance of a small image with one position per pixel, which tells how bright
    /// the scene is whatever the size and the sampling of the images that are judged.
    ///
    /// # Errors
    /// If the scene cannot be traced.
    pub fn glance(scene: &'a Scene) -> Result<Vec<f64>, Error> {
        let [width, height] = scene.camera.resolution_px;
        let scaled = |side: u32| (side * GLANCE_PX / width.max(height)).max(1);
        let job = Self::estimate(scene, [scaled(width), scaled(height)], 1, GLANCE_CUT);
        let rendering = reference::render(scene, &job.request)?;
        let radiance = rendering.layers.get(&LayerName::Radiance);
        Ok(radiance.map(|layer| layer.data.clone()).unwrap_or_default())
    }

    fn tree(
        scene: &'a Scene,
        resolution_px: [u32; 2],
        positions_per_axis: u32,
        cut: f64,
        layers: Vec<LayerName>,
    ) -> Self {
        let view = View { resolution_px, positions_per_axis, frame: 0, layers };
        // Opaque surroundings count where there are any.
        let bodies = scene.objects.iter();
        let opaque = bodies.filter(|object| scene.medium_of(object).is_none()).count() > 0;
        let level = if opaque { Level::R2 } else { Level::R1 };
        let request = Request { estimator: Estimator::Tree { cut }, ..Request::new(view, level) };
        Self { scene, request }
    }

    /// Content id.
    #[must_use]
    pub fn id(&self) -> Id {
        Id::of(&Description {
            sources: env!("SNELL_EXACT_SOURCES"),
            scene: &self.scene.source.sha256,
            request: format!("{:?}", self.request),
        })
    }

    /// Takes the image from the store, or traces and stores it. `progress` is
    /// told the share that is done, 0 to 1.
    ///
    /// # Errors
    /// If the scene cannot be traced or the store cannot be used.
    pub fn make(&self, store: &Store, progress: &(dyn Fn(f64) + Sync)) -> Result<Made, Error> {
        let id = self.id();
        if let Some(made) = Made::find(store, &id) {
            return Ok(made);
        }
        let watch = Watch { progress: Some(progress), ..Watch::default() };
        Made::store(store, &id, reference::render_watched(self.scene, &self.request, watch)?)
    }

    /// What tells one exact image of a scene from another.
    #[must_use]
    pub fn parameters(&self) -> BTreeMap<String, String> {
        let view = &self.request.view;
        let mut list = vec![("samples", (view.positions_per_axis.pow(2)).to_string())];
        if let Estimator::Tree { cut } = self.request.estimator {
            list.push(("cut", format!("{cut:e}")));
        }
        list.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Camera rays that the image takes.
    #[must_use]
    pub fn camera_rays(&self) -> f64 {
        let View { resolution_px: [width, height], positions_per_axis: k, .. } = self.request.view;
        f64::from(width) * f64::from(height) * f64::from(k * k)
    }
}

/// True if no position (i + ½)/k of a k x k pattern is one of a j x j pattern.
///
/// (2i + 1) j = (2i' + 1) k has a solution exactly if j and k hold the same
/// power of two.
#[must_use]
pub fn is_disjoint(k: u32, j: u32) -> bool {
    k.trailing_zeros() != j.trailing_zeros()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_of_different_powers_of_two_share_no_position() {
        for k in 1..=12 {
            for j in 1..=12 {
                // Positions in units of 1/(2jk), which are whole numbers.
                let shared = (0..k).any(|i| (0..j).any(|m| (2 * i + 1) * j == (2 * m + 1) * k));
                assert_eq!(is_disjoint(k, j), !shared, "{k} {j}");
            }
        }
    }
}
