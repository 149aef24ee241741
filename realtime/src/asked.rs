//! What was asked for, looked up and checked.

use crate::composition::inputs::Inputs;
use crate::composition::outputs::camera;
use crate::drawn::frame_uniforms::Viewed;
use crate::drawn::geometry::Geometry;
use crate::error::Error;
use crate::frame::Composition;
use crate::frames::FrameRequest;
use crate::methods::{Method, Settings};
use crate::request::Request;
use crate::wgsl::Choices;
use glam::DVec2;
use scenes::{Camera, Scene};
use std::borrow::Cow;

/// A request, and what follows from it before any frame does.
pub(crate) struct Asked<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) request: &'a Request,
    pub(crate) method: &'static Method,
    pub(crate) settings: &'a Settings,
    pub(crate) geometry: Geometry,
    pub(crate) camera: Camera,
}

impl<'a> Asked<'a> {
    pub(crate) fn new(
        scene: &'a Scene,
        request: &'a Request,
        method: &'static Method,
        settings: &'a Settings,
    ) -> Result<Self, Error> {
        let geometry = if method.follows_rays {
            let mut geometry = Geometry::for_rays(scene, request.view.frame)?;
            geometry.remember_first(scene)?;
            geometry
        } else {
            Geometry::new(scene, request.view.frame)?
        };
        let camera = camera(scene, request);
        Ok(Self { scene, request, method, settings, geometry, camera })
    }

    pub(crate) fn inputs<'b>(&'b self, frame: &'b FrameRequest) -> Inputs<'b> {
        Inputs {
            method: self.method,
            settings: self.settings,
            scene: self.scene,
            camera: &self.camera,
            geometry: &self.geometry,
            request: &frame.request,
            outputs: &frame.outputs,
            resolution_px: self.request.view.resolution_px,
            choices: Choices::default(),
            index_matched: false,
        }
    }

    /// The geometry as a frame draws it.
    pub(crate) fn drawn(&self, composition: &Composition<'_>) -> Cow<'_, Geometry> {
        let mut geometry = Cow::Borrowed(&self.geometry);
        if composition.draws_clipped_cracks() {
            geometry.to_mut().clip_cracks(self.scene, self.request.view.frame);
        }
        geometry
    }

    /// What a frame shows at a shift.
    pub(crate) fn viewed<'b>(&'b self, geometry: &'b Geometry, shift: DVec2) -> Viewed<'b> {
        Viewed {
            geometry,
            environment: &self.scene.environment,
            camera: &self.camera,
            eta_outside: self.scene.media[0].eta.get(),
            resolution_px: self.request.view.resolution_px,
            shift,
        }
    }
}
