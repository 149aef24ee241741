//! What is to be composed, and the decisions that follow from it alone.

use crate::composition::chosen::{camera_piece, piece, stored_normal_piece, vector_piece};
use crate::drawn::geometry::Geometry;
use crate::drawn::projection::{in_view, projected_px};
use crate::drawn::uniforms::Body;
use crate::methods::{Method, Settings};
use crate::request::{Filter, Keep, Request};
use crate::wgsl::Piece;
use glam::DVec2;
use scenes::{Camera, Environment, LayerName, Scene};

/// What is to be composed.
#[derive(Clone, Copy)]
pub(crate) struct Order<'a> {
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
}

impl Order<'_> {
    /// How an interface becomes 32 bits.
    pub(crate) fn pack(&self) -> Piece {
        if self.geometry.nested {
            piece!("layers/pack_nested.wgsl")
        } else {
            piece!("layers/pack_single.wgsl")
        }
    }

    /// What every pass that draws the bodies begins with.
    pub(crate) fn raster_head(&self) -> Vec<Piece> {
        self.raster_head_of(camera_piece(self.camera))
    }

    /// The same for another camera.
    pub(crate) fn raster_head_of(&self, camera: Piece) -> Vec<Piece> {
        let mut head = vec![piece!("core/frame.wgsl"), camera];
        head.extend(vector_piece(self.method, self.settings));
        match self.geometry.bumps {
            Some(_) => head.extend([piece!("core/noise.wgsl"), piece!("raster/bump.wgsl")]),
            None => head.push(piece!("raster/bump_none.wgsl")),
        }
        head.push(stored_normal_piece(self.settings));
        head
    }

    /// Nothing that could be left out is.
    pub(crate) fn keeps_all(&self) -> bool {
        self.request.keep == Keep::Everything
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

    /// The bodies have the index of what is around them and take no light. What
    /// is interpolated between vertices bends a little even so, and eq. 4 of
    /// Seipel & Nivfors reflects whatever the index: they are left as they are.
    pub(crate) fn is_index_matched(&self) -> bool {
        let outside = self.scene.media[0].eta.get();
        let same = |body: &Body| (f64::from(body.eta) / outside - 1.0).abs() < 1e-7;
        let geometry = self.geometry;
        let bends_anyway = self.method.id.ends_with("-vertex")
            || self.settings.word_if_any("fresnel") == Some("eq4");
        !self.keeps_all()
            && !bends_anyway
            && geometry.media.iter().all(same)
            && !geometry.absorbs
            && !geometry.disperses
    }

    /// Opaque surfaces stand around the bodies.
    pub(crate) fn draws_backdrop(&self) -> bool {
        !self.geometry.opaque.is_empty()
    }

    /// How the environment is looked up: the scene's, or one that was drawn.
    pub(crate) fn environment_piece(&self, drawn: bool) -> Piece {
        match (&self.scene.environment, self.request.filter) {
            (Environment::Uniform(_), _) if !drawn => {
                piece!("environment/environment_uniform.wgsl")
            }
            (_, Filter::Manual) => piece!("environment/environment_manual.wgsl"),
            (_, Filter::Hardware) => piece!("environment/environment_sampler.wgsl"),
        }
    }
}

pub(crate) fn asked(request: &Request, name: &str) -> bool {
    request.view.layers.iter().any(|layer| match layer {
        LayerName::Buffer(buffer) if buffer == "thickness" => name.ends_with("_depth"),
        LayerName::Buffer(buffer) => buffer == name,
        _ => false,
    })
}
