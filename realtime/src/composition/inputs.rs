//! What passes are composed from: what was asked for, and what follows from that
//! alone.

use crate::drawn::geometry::Geometry;
use crate::drawn::projection::{in_view, projected_px};
use crate::drawn::uniforms::Body;
use crate::methods::{Method, Settings};
use crate::request::{Keep, Request};
use crate::wgsl::Choices;
use glam::{DVec2, DVec3};
use scenes::{Camera, LayerName, Projection, Scene};

/// What a frame is composed for.
#[derive(Clone)]
pub(crate) struct Inputs<'a> {
    pub(crate) method: &'static Method,
    pub(crate) settings: &'a Settings,
    pub(crate) scene: &'a Scene,
    pub(crate) camera: &'a Camera,
    pub(crate) geometry: &'a Geometry,
    pub(crate) request: &'a Request,
    /// Images that shading writes.
    pub(crate) outputs: &'a [&'static str],
    /// Of the surface buffers.
    pub(crate) resolution_px: [u32; 2],
    /// Files for the shaders' needs; made by [`super::chosen::decided`].
    pub(crate) choices: Choices,
    /// Nothing bends light here; found by [`super::chosen::decided`].
    pub(crate) index_matched: bool,
}

impl Inputs<'_> {
    /// Nothing that could be left out is.
    pub(crate) fn keeps_all(&self) -> bool {
        self.request.keep == Keep::Everything
    }

    /// Rays from the camera may begin inside a body.
    pub(crate) fn may_start_inside(&self) -> bool {
        let Camera { eye, .. } = *self.camera;
        let forward = self.camera.basis().forward;
        let parallel = matches!(self.camera.projection, Projection::Orthographic { .. });
        self.geometry.outlines.iter().any(|corners| {
            if !corners.iter().all(|corner| corner.is_finite()) {
                return true;
            }
            if parallel {
                let depth_m = |corner: &DVec3| (*corner - eye).dot(forward);
                return corners.iter().map(depth_m).fold(f64::INFINITY, f64::min) <= 0.0;
            }
            let low = corners.iter().fold(DVec3::INFINITY, |low, corner| low.min(*corner));
            let high = corners.iter().fold(DVec3::NEG_INFINITY, |high, corner| high.max(*corner));
            eye.cmpge(low).all() && eye.cmple(high).all()
        })
    }

    /// No body's bounds reach into the image, and nobody asks for its buffers.
    pub(crate) fn is_off_screen(&self) -> bool {
        let asks = self.request.view.layers.iter().any(|l| matches!(l, LayerName::Buffer(_)));
        let shown = || self.geometry.outlines.iter().any(|corners| in_view(self.camera, corners));
        !self.keeps_all() && !asks && !shown()
    }

    /// The rectangle of pixels around the bodies' bounds, with a pixel to spare.
    /// None if it is the whole image, or a corner lies behind the eye.
    pub(crate) fn within_px(&self) -> Option<[u32; 4]> {
        if self.keeps_all() {
            return None;
        }
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for corner in self.geometry.outlines.iter().flatten() {
            let at = projected_px(self.camera, *corner, self.resolution_px)?;
            (low, high) = (low.min(at), high.max(at));
        }
        let size = DVec2::from_array(self.resolution_px.map(f64::from));
        let low = (low.floor() - 1.0).clamp(DVec2::ZERO, size);
        let high = (high.ceil() + 1.0).clamp(DVec2::ZERO, size);
        let extent = high - low;
        let partial = extent.min_element() >= 1.0 && extent != size;
        partial.then(|| [low.x, low.y, extent.x, extent.y].map(|v| v as u32))
    }

    /// The bodies have the index of what is around them and take no light.
    pub(super) fn is_index_matched(&self) -> bool {
        let outside = self.scene.media[0].eta.get();
        let same = |body: &Body| (f64::from(body.eta) / outside - 1.0).abs() < 1e-7;
        let geometry = self.geometry;
        !self.keeps_all()
            && geometry.media.iter().all(same)
            && !geometry.absorbs
            && !geometry.disperses
    }

    /// Opaque surfaces stand around the bodies, and are drawn.
    pub(crate) fn draws_backdrop(&self) -> bool {
        !self.geometry.opaque.is_empty() && !self.method.follows_rays
    }

    /// Rays meet the bodies and what stands around them, and there is something
    /// that they can change.
    pub(crate) fn follows_rays(&self) -> bool {
        let alone = self.geometry.opaque.is_empty();
        self.method.follows_rays && !(alone && (self.index_matched || self.is_off_screen()))
    }

    /// The scene has cracks and the method can show them.
    pub(crate) fn shows_cracks(&self) -> bool {
        self.settings.word_if_any("clip").is_some() && !self.geometry.cracks.is_empty()
    }

    /// The scene has enclosed air and the method can show it.
    pub(crate) fn shows_air(&self) -> bool {
        self.settings.word_if_any("clip").is_some() && !self.geometry.air.is_empty()
    }

    /// The method is a user's that does not say what it needs.
    pub(crate) fn may_need_anything(&self) -> bool {
        !self.index_matched && self.method.source.head().needs.is_none()
    }

    /// Cracks are drawn whose sheets end at the body's surface by themselves.
    pub(crate) fn draws_clipped_cracks(&self) -> bool {
        self.settings.word_if_any("clip") == Some("mesh")
            && (self.shows_cracks() || self.shows_air())
            && !self.is_off_screen()
    }

    /// An intermediate buffer was asked for.
    pub(crate) fn asked_for(&self, name: &str) -> bool {
        self.request.view.layers.iter().any(|layer| match layer {
            LayerName::Buffer(buffer) if buffer == "thickness" => name.ends_with("_depth"),
            LayerName::Buffer(buffer) => buffer == name,
            _ => false,
        })
    }
}
