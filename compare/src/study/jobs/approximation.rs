//! The job of rendering and timing an approximation.

use super::Made;
use crate::Error;
use crate::results::PARAM;
use crate::study::cache::Id;
use realtime::{Filter, Gpu, Keep, Method, Request, Timing};
use scenes::rendering::Pass;
use scenes::{LayerName, Layers, Scene, View};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// A method's image of a scene, and how long it takes.
#[derive(Clone, Debug)]
pub struct Approximation<'a> {
    /// What is rendered.
    pub scene: &'a Scene,
    /// How.
    pub request: Request,
}

/// All that the image depends on.
#[derive(Serialize)]
struct Description<'a> {
    sources: &'a str,
    scene: &'a str,
    request: String,
    /// Of a method from a user's file.
    method: Option<&'a str>,
    adapter: &'a str,
    driver: &'a str,
}

impl<'a> Approximation<'a> {
    /// The image that is judged against [`super::Exact::truth`], with the same
    /// size and positions, timed for `timing_s` seconds.
    #[must_use]
    pub fn judged(
        scene: &'a Scene,
        view: &View,
        method: &str,
        parameters: BTreeMap<String, String>,
        timing_s: f64,
    ) -> Self {
        let layers =
            vec![LayerName::Radiance, LayerName::Coverage, LayerName::Exit, LayerName::Flags];
        let view = View { layers, ..view.clone() };
        let timing = Timing { seconds: timing_s, ..Timing::default() };
        let request = Request {
            view,
            method: method.to_owned(),
            parameters,
            filter: Filter::Manual,
            timing: Some(timing),
            keep: Keep::Needed,
        };
        Self { scene, request }
    }

    /// The light alone, at k x k positions per pixel, not timed.
    #[must_use]
    pub fn light_at(&self, k: u32) -> Self {
        let layers = vec![LayerName::Radiance];
        let view = View { layers, positions_per_axis: k, ..self.request.view.clone() };
        Self { scene: self.scene, request: Request { view, timing: None, ..self.request.clone() } }
    }

    /// The frame that is timed, drawn at k x k positions per pixel, one after the
    /// other.
    #[must_use]
    pub fn timed_at(&self, k: u32) -> Self {
        let view = View { layers: Vec::new(), ..self.request.view.clone() };
        let timing = self.request.timing.map(|t| Timing { positions_per_axis: k, ..t });
        Self { scene: self.scene, request: Request { view, timing, ..self.request.clone() } }
    }

    /// Renders and keeps the layers in memory, narrowed as a file would.
    ///
    /// # Errors
    /// If the method cannot show the scene.
    pub fn layers(&self, gpu: &Gpu) -> Result<Layers, Error> {
        Ok(realtime::render(gpu, self.scene, &self.request)?.layers)
    }

    /// Content id: the same image, though never the same time.
    #[must_use]
    pub fn id(&self, gpu: &Gpu) -> Id {
        let adapter = gpu.info();
        Id::of(&Description {
            sources: env!("SNELL_REALTIME_SOURCES"),
            scene: &self.scene.source.sha256,
            request: format!("{:?}", self.request),
            method: Method::find(&self.request.method).ok().and_then(Method::file_text),
            adapter: &adapter.name,
            driver: &adapter.driver,
        })
    }

    /// The frame that is timed, with everything in it that the scene does not
    /// need; `None` where nothing was left out that could be put back.
    ///
    /// # Errors
    /// If the method cannot show the scene.
    pub fn with_all_kept(&self) -> Result<Option<Self>, Error> {
        let view = View {
            layers: vec![LayerName::Radiance],
            positions_per_axis: 1,
            ..self.request.view.clone()
        };
        let lean = Request { view, ..self.request.clone() };
        let full = Request { keep: Keep::Everything, ..lean.clone() };
        let same = realtime::plan(self.scene, &lean)? == realtime::plan(self.scene, &full)?;
        // Only the frame that is timed, and three times: it is a comparison.
        let mut request = full;
        request.view.layers.clear();
        if let Some(timing) = &mut request.timing {
            *timing = Timing { warm_up: 1, seconds: 0.0, min_frames: 3, ..*timing };
        }
        Ok((!same).then_some(Self { scene: self.scene, request }))
    }

    /// Times the frame and keeps no image.
    ///
    /// # Errors
    /// If the method cannot show the scene.
    pub fn passes(&self, gpu: &Gpu) -> Result<Vec<Pass>, Error> {
        Ok(realtime::render(gpu, self.scene, &self.request)?.passes)
    }

    /// Renders and times the image and writes it to `image`. It is never taken
    /// from the store: its time is a measurement, not a result that keeps. The file
    /// tells what it is by these attributes and the method's parameters.
    ///
    /// # Errors
    /// If the method cannot show the scene or the image cannot be written.
    pub fn make(
        &self,
        gpu: &Gpu,
        image: &Path,
        mut attributes: BTreeMap<String, String>,
    ) -> Result<Made, Error> {
        let rendering = realtime::render(gpu, self.scene, &self.request)?;
        let parameters = rendering.provenance.parameters.iter();
        attributes
            .extend(parameters.map(|(name, value)| (format!("{PARAM}{name}"), value.clone())));
        Made::write(self.id(gpu), image, rendering, &attributes)
    }
}
